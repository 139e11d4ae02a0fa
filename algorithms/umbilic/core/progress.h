// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>

namespace umbilic {

/// Receives the fraction done, in [0, 1], and the name of the stage; returns false to stop the work.
using ProgressCallback = std::function<bool(double fraction, std::string_view stage)>;

/// Copyable handle through which long work reports and learns that it shall stop. All copies share one state, and any
/// thread may call any function. A default-constructed handle is silent and cannot be cancelled by a callback.
class Progress {
public:
    Progress();
    explicit Progress(ProgressCallback callback);

    /// Reports a fraction of this handle's own range and throws Cancelled if the work shall stop. The callback is
    /// called by one thread at a time.
    void report(double fraction, std::string_view stage) const;

    /// Throws Cancelled if cancel() was called; cheap enough for inner loops.
    void check() const;

    /// Asks the work to stop at its next report() or check().
    void cancel() const;
    bool cancelled() const;

    /// Handle whose range [0, 1] is the part [low, high] of this one's.
    Progress part(double low, double high) const;

private:
    struct State {
        ProgressCallback callback;
        std::mutex mutex;
        std::atomic<bool> cancelled{false};
    };
    std::shared_ptr<State> state_;
    double low_ = 0.0;
    double high_ = 1.0;
};

}  // namespace umbilic
