// couloir: the command line. Verbs live in files of their own; only this one sets exit codes.
//
//   0 done   1 a check failed   2 the user's input is wrong   3 the run failed (its state is saved and named)   4 an engine
//   failed

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "app/verbs.hpp"
#include "continuum/errors.hpp"
#include "continuum/isa/isa.hpp"
#include "continuum/mesh/ranks.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/checkpoint/checkpoint_error.hpp"
#include "coupling/engine/engine_error.hpp"
#include "coupling/loop/interrupted.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/scene/scene_error.hpp"

namespace {

// What goes wrong is told once: the first rank has the word, and ends the others; one that is still there then speaks itself.
int fail(int code, const char* kind, const std::string& sentence) {
  if (couloir::Ranks::is_another()) sleep(2);
  std::fprintf(stderr, "couloir: %s: %s\n", kind, sentence.c_str());
  std::fflush(stderr);
  couloir::Ranks::end_all(code);
  return code;
}

int fail(int code, const char* kind, const std::exception& error) {
  return fail(code, kind, std::string(error.what()));
}

constexpr const char* wrong_input = "error in the input";

// What CLI11 finds wrong, with a remedy; or the help that was asked for.
int end_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return couloir::Ranks::is_another() ? 0 : app.exit(error);
  const auto verbs = app.get_subcommands();
  const std::string remedy =
      verbs.empty() ? "couloir --help lists the verbs" : "couloir " + verbs.front()->get_name() + " --help lists what it takes";
  return fail(2, wrong_input, std::string(error.what()) + "; " + remedy);
}

// CLI11 names neither the word nor what there is. True: it has been told.
bool unknown_verb(const CLI::App& app, const std::string& word) {
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == word) return false;
    verbs += verb->get_name() + ", ";
  }
  fail(2, wrong_input, "there is no verb '" + word + "'; there are " + verbs + "and docs and test at the front door ./couloir.");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace couloir;
  CLI::App app{"Granular avalanches that hit obstacles: a depth-averaged flow coupled to discrete grains.", "couloir"};
  app.require_subcommand(1);
  app.footer("./couloir docs   builds the pages of docs/ as a site\n./couloir test   builds and runs all tests");
  int exit_code = 0;
  add_plan(app, exit_code);
  add_run(app, exit_code);
  add_resume(app, exit_code);
  add_reproduce(app, exit_code);
  add_report(app, exit_code);
  add_check(app, exit_code);
  add_study(app, exit_code);
  add_advise(app, exit_code);
  add_calibrate(app, exit_code);
  add_bench(app, exit_code);
  if (argc > 1 && argv[1][0] != '-' && unknown_verb(app, argv[1])) return 2;
  try {
    chosen_isa();  // a wrong COULOIR_ISA is told before anything is made
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return end_parse(app, error);
  } catch (const IsaError& error) {
    return fail(2, wrong_input, error);
  } catch (const SceneError& error) {
    return fail(2, wrong_input, error);
  } catch (const EngineError& error) {
    return fail(4, "the grain engine failed", error);
  } catch (const NumericsError& error) {
    return fail(3, "the run failed", error);
  } catch (const CheckpointError& error) {
    return fail(3, "the run failed", error);
  } catch (const RecordError& error) {
    return fail(3, "the run failed", error);
  } catch (const Interrupted& error) {
    return fail(3, "interrupted", error);
  } catch (const Stopped& error) {
    return fail(3, "interrupted", error);
  } catch (const std::exception& error) {
    return fail(3, "internal error", error);
  }
}
