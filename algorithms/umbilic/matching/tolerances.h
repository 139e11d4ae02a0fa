// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace umbilic {

/// Distances within which samples count as lying on the other model, as parts of the length (twice the root mean square
/// radius) of the smaller of the two models; what the files leave open (conversion errors, stated tolerances) is added.
/// Measured on free-form designs: exact copies end at 1e-15, copies re-approximated to 1e-4 of sqrt(area) at 1e-4;
/// independent designs with free scale never had 0.95 of their area within 1e-3.
struct FitTolerance {
    static constexpr double exact = 1e-5;
    static constexpr double reapproximated = 3e-4;
    static constexpr double measured = 1e-3;
    static constexpr double resembling = 1e-2;
};

/// Stated tolerances and conversion errors count up to this part of the length: files that state nonsense must not make
/// everything fit.
inline constexpr double greatest_stated_tolerance = 1e-4;

/// Two poses whose refined positions differ by less than this part of the suspect's length are one.
inline constexpr double same_pose = 1e-3;

}  // namespace umbilic
