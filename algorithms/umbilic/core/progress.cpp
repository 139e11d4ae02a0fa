// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/core/progress.h>

#include <utility>

#include <umbilic/core/errors.h>

namespace umbilic {

Progress::Progress() : Progress(ProgressCallback()) {}

Progress::Progress(ProgressCallback callback) : state_(std::make_shared<State>()) {
    state_->callback = std::move(callback);
}

void Progress::report(double fraction, std::string_view stage) const {
    check();
    if (!state_->callback) return;
    const std::lock_guard lock(state_->mutex);
    if (!state_->callback(low_ + fraction * (high_ - low_), stage)) state_->cancelled = true;
    check();
}

void Progress::check() const {
    if (state_->cancelled) throw Cancelled("stopped on request");
}

void Progress::cancel() const {
    state_->cancelled = true;
}

bool Progress::cancelled() const {
    return state_->cancelled;
}

Progress Progress::part(double low, double high) const {
    Progress result = *this;
    result.low_ = low_ + low * (high_ - low_);
    result.high_ = low_ + high * (high_ - low_);
    return result;
}

}  // namespace umbilic
