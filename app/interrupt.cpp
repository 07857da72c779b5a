#include "app/interrupt.hpp"

#include <csignal>

namespace vicus::app {
namespace {

// A signal handler may touch nothing else: the one mark that lives outside all functions.
volatile std::sig_atomic_t mark = 0;

void onSignal(int signal) {
  mark = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool interrupted() {
  return mark != 0;
}

}  // namespace vicus::app
