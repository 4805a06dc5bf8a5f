#include "app/stop_signal.hpp"

#include <csignal>
#include <initializer_list>

namespace couloir {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void note_stop_signals() {
  interrupted = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) std::signal(signal, on_signal);
}

bool told_to_stop() {
  return interrupted != 0;
}

}  // namespace couloir
