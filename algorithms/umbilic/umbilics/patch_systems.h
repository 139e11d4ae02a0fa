// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include <umbilic/bernstein/projected_polyhedron.h>
#include <umbilic/core/errors.h>
#include <umbilic/core/progress.h>

namespace umbilic {

// Systems of polynomial equations on the Bezier patches of a surface, by the general solver.

/// The solver's options on a patch. Throws InvalidInput, `what` before it, if the tolerance does not lie between 1e-14
/// and 1 or there are no boxes.
inline ProjectedPolyhedronOptions patch_limits(const std::string& what, double tolerance, long boxes_per_patch) {
    if (!(tolerance >= 1e-14 && tolerance < 1.0))
        throw InvalidInput(what + ": the tolerance must lie between 1e-14 and 1");
    if (boxes_per_patch < 1) throw InvalidInput(what + ": boxes_per_patch must be at least 1");
    ProjectedPolyhedronOptions limits;
    limits.tolerance = tolerance;
    limits.boxes = boxes_per_patch;
    return limits;
}

/// solve(k, progress) of every patch k < count, in parallel. Throws what it throws, Cancelled.
template <class Result, class Solve>
std::vector<Result> on_patches(std::size_t count, const std::string& stage, const Progress& progress,
                               const Solve& solve) {
    std::vector<Result> found(count);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t k) {
        const auto fraction = [&] { return static_cast<double>(done) / static_cast<double>(count); };
        // Patches end in any order, so the fraction is counted in patches; within one it stands still.
        const Progress within = progress.part(fraction(), fraction());
        within.check();
        found[k] = solve(k, within);
        ++done;
        progress.report(fraction(), stage);
    });
    return found;
}

}  // namespace umbilic
