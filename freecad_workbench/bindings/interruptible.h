// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <umbilic/core/progress.h>

namespace umbilic::python {

/// What long work has last reported, handed from the working thread to the one that waits.
class LatestReport {
public:
    void set(double fraction, std::string_view stage) {
        const std::lock_guard lock(mutex_);
        fraction_ = fraction;
        stage_ = stage;
    }
    std::pair<double, std::string> get() const {
        const std::lock_guard lock(mutex_);
        return {fraction_, stage_};
    }

private:
    mutable std::mutex mutex_;
    double fraction_ = 0.0;
    std::string stage_;
};

/// Runs `work(progress)` in a thread of its own with the GIL released, while the calling thread hands the latest report
/// to `callback(fraction, text)` (a Python callable or None) every 50 ms and looks for Ctrl-C.
///
/// So the callback runs in the caller's thread, however many threads work, and work that reports seldom is still told
/// to stop at once: Progress::check() sees it. A callback that returns False (None means: go on) ends the call with
/// Cancelled; an exception it raises comes out of the call as it is, after the work has stopped. It is called at least
/// once, at the start.
template <class Work>
auto run_interruptible(const pybind11::object& callback, Work&& work) {
    namespace py = pybind11;
    constexpr auto poll_interval = std::chrono::milliseconds(50);

    LatestReport latest;
    const Progress progress([&latest](double fraction, std::string_view stage) {
        latest.set(fraction, stage);
        return true;
    });
    py::gil_scoped_release without_gil;
    // Declared after what the work refers to: the destructor of a future of std::async waits for the work.
    auto result = std::async(std::launch::async, [&] { return work(progress); });
    try {
        do {
            const auto [fraction, stage] = latest.get();
            py::gil_scoped_acquire with_gil;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (callback.is_none()) continue;
            const py::object go_on = callback(fraction, stage);
            if (!go_on.is_none() && PyObject_IsTrue(go_on.ptr()) == 0) progress.cancel();
        } while (result.wait_for(poll_interval) != std::future_status::ready);
    } catch (...) {
        progress.cancel();
        result.wait();
        throw;
    }
    auto value = result.get();
    progress.check();  // work that ended before it heard of the cancellation is cancelled all the same
    return value;
}

}  // namespace umbilic::python
