// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/interrupt.h>

#include <atomic>
#include <csignal>

namespace umbilic {

namespace {

// A signal handler can only reach what is global; cancel() stores into a lock-free atomic.
static_assert(std::atomic<bool>::is_always_lock_free);
const Progress* interrupted = nullptr;

void on_signal(int) {
    interrupted->cancel();
}

}  // namespace

void cancel_on_signals(const Progress& progress) {
    interrupted = &progress;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace umbilic
