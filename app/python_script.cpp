#include "app/python_script.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <stdexcept>

#include "app/scene_options.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/scene/scene_error.hpp"

extern char** environ;

namespace couloir {

void run_python(const std::string& script, const std::vector<std::string>& arguments, const std::string& what) {
  std::vector<std::string> words{"/usr/bin/python3", script};
  words.insert(words.end(), arguments.begin(), arguments.end());
  setenv("MPLCONFIGDIR", plot_cache_folder().c_str(), 0);  // else matplotlib writes into the user's home
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = 0;
  int status = 1;
  if (posix_spawn(&pid, argv[0], nullptr, nullptr, argv.data(), environ) != 0)
    throw std::runtime_error("/usr/bin/python3 cannot be run");
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 2) throw SceneError(what + " (see the line above)");
  if (status != 0) throw RecordError(what + "; the records are untouched (see the lines above)");
}

}  // namespace couloir
