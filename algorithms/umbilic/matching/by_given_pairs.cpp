// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/by_given_pairs.h>

namespace umbilic {

std::vector<ConsistentPointFit> fit_given_pairs(const MatchOptions& options) {
    std::vector<ConsistentPointFit> fits;
    if (options.pairs.empty()) return fits;
    std::vector<PointPair> pairs;
    for (const auto& [original, suspect] : options.pairs) pairs.push_back({original, suspect});
    for (const bool mirrored : {false, true})
        if (!mirrored || options.mirror == MirrorChoice::automatic)
            fits.push_back(fit_consistent_points(
                pairs, {.free_scale = options.scale.kind != ScaleChoice::Kind::fixed, .mirrored = mirrored}));
    return fits;
}

std::string described(std::span<const ConsistentPointFit> fits) {
    if (fits.empty()) return {};
    // Of two hands the one that leaves out fewer pairs, and fits those better.
    const ConsistentPointFit* best = &fits.front();
    for (const ConsistentPointFit& fit : fits)
        if (fit.outliers.size() < best->outliers.size() ||
            (fit.outliers.size() == best->outliers.size() && fit.deviation < best->deviation))
            best = &fit;
    std::string text = std::to_string(best->residuals.size()) + " given pairs of points";
    if (best->outliers.empty()) return text;
    text += " without number";
    for (std::size_t k = 0; k < best->outliers.size(); ++k)
        text += (k == 0 ? " " : ", ") + std::to_string(best->outliers[k] + 1);
    return text + (best->outliers.size() == 1 ? ", which does" : ", which do") + " not agree with the others";
}

std::vector<GivenPair> judged_pairs(std::span<const ConsistentPointFit> fits, bool mirrored) {
    std::vector<GivenPair> result;
    for (const ConsistentPointFit& fit : fits) {
        if (fit.original_suspect.mirrored != mirrored) continue;
        for (const double residual : fit.residuals) result.push_back({residual, false});
        for (const int k : fit.outliers) result[k].outlier = true;
    }
    return result;
}

}  // namespace umbilic
