// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressRange.hxx>
#include <Message_ProgressScope.hxx>

#include <umbilic/core/progress.h>

namespace umbilic {

/// Hands the kernel's progress on. Must outlive the call that was given start().
class KernelProgress {
public:
    KernelProgress(const Progress& progress, std::string stage)
        : indicator_(new Indicator(progress, std::move(stage))) {}
    Message_ProgressRange start() const { return indicator_->Start(); }

private:
    class Indicator : public Message_ProgressIndicator {
    public:
        Indicator(const Progress& progress, std::string stage) : progress_(progress), stage_(std::move(stage)) {}
        Standard_Boolean UserBreak() override { return progress_.cancelled(); }
        void Show(const Message_ProgressScope&, const Standard_Boolean) override {
            if (!progress_.cancelled()) progress_.report(GetPosition(), stage_);
        }

    private:
        Progress progress_;
        std::string stage_;
    };
    opencascade::handle<Indicator> indicator_;
};

}  // namespace umbilic
