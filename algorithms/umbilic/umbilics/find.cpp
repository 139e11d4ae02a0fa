// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/find.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/characterise.h>
#include <umbilic/umbilics/clusters.h>
#include <umbilic/umbilics/duplicates.h>
#include <umbilic/umbilics/patch_search.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// Boxes are split down to this share of their patch however small the patch is: the resolution is relative to the
/// whole domain, and a narrow patch needs some boxes of its own.
constexpr double coarsest_patch_size = 1.0 / 16;

/// Breaks across which the surface is less than twice continuously differentiable, and the two ends: borders of blocks
/// on which the principal directions are continuous.
std::vector<bool> block_borders(const KnotVector& knots) {
    std::vector<bool> result(knots.breaks().size());
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = knots.continuity(static_cast<int>(k)) < 2;
    result.front() = result.back() = true;
    return result;
}

std::vector<PatchUmbilics> search_patches(const NurbsSurface& surface, const BezierPatches& patches,
                                          const InputRounding& input, const UmbilicOptions& options,
                                          const Progress& progress) {
    const ParameterBox domain = surface.domain();
    const std::vector<bool> u_border = block_borders(surface.u_knots()), v_border = block_borders(surface.v_knots());
    std::vector<PatchUmbilics> result(patches.patches.size());
    tbb::enumerable_thread_specific<PatchSearch> searches;
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, result.size()), [&](const auto& range) {
        PatchSearch& search = searches.local();
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
            progress.check();
            const BezierPatch& patch = patches.patches[k];
            const std::size_t i = k / patches.v_count, j = k % patches.v_count;
            PatchTask task;
            task.limits.u_size =
                std::min(coarsest_patch_size, options.resolution * domain.u.length() / patch.domain.u.length());
            task.limits.v_size =
                std::min(coarsest_patch_size, options.resolution * domain.v.length() / patch.domain.v.length());
            task.limits.boxes = options.boxes_per_patch;
            if (options.certificate) task.edges = {u_border[i], u_border[i + 1], v_border[j], v_border[j + 1]};
            result[k] = search.search(patch, input, task, progress);
        }
        done += range.size();
        progress.report(static_cast<double>(done) / static_cast<double>(result.size()), "umbilics");
    });
    return result;
}

Certificate make_certificate(const BezierPatches& patches, const std::vector<PatchUmbilics>& found,
                             const FaceUmbilics& result, bool wanted, bool collapsed) {
    Certificate certificate;
    for (const Umbilic& umbilic : result.umbilics) certificate.index_sum += umbilic.index;
    double angle = 0.0;
    bool evaluated = true;
    for (std::size_t k = 0; k < patches.patches.size(); ++k)
        for (const Edge edge : {Edge::u_low, Edge::u_high, Edge::v_low, Edge::v_high}) {
            const EdgeTurning& turning = found[k].turning[static_cast<int>(edge)];
            if (!turning.wanted) continue;
            if (!turning.angle)
                evaluated = false;
            else
                angle += edge == Edge::v_low || edge == Edge::u_high ? *turning.angle : -*turning.angle;
        }
    const std::optional<double> turns = evaluated ? whole_turns(angle) : std::nullopt;
    if (!wanted)
        certificate.why = "not asked for";
    else if (!result.regions.empty())
        certificate.why = "there are umbilic regions";
    else if (!result.lines.empty())
        certificate.why = "there are lines of umbilics";
    else if (collapsed)
        certificate.why = "an edge of the surface is collapsed to a point";
    else if (!turns)
        certificate.why = "an umbilic lies on, or too near to, the border of the surface or of one of its smooth parts";
    else if (!result.undecided.empty())
        certificate.why = "some boxes are undecided";
    else {
        certificate.boundary_winding = 0.5 * *turns;
        certificate.complete = certificate.boundary_winding == certificate.index_sum;
        if (!*certificate.complete) certificate.why = "the indices found do not sum to the winding along the border";
    }
    return certificate;
}

/// Answers for kinds of surface whose umbilics are known; false for all others.
bool answer_elementary(const Face& face, FaceUmbilics& result) {
    switch (face.kind) {
        case SurfaceKind::plane:
        case SurfaceKind::sphere: {
            UmbilicRegion region = make_region(face.surface, {face.surface.domain()});
            region.kind = face.kind == SurfaceKind::plane ? UmbilicRegionKind::planar : UmbilicRegionKind::spherical;
            result.regions.push_back(std::move(region));
            result.certificate.why = "there are umbilic regions";
            return true;
        }
        case SurfaceKind::cylinder:
        case SurfaceKind::cone:
        case SurfaceKind::torus:
            // One principal curvature is everywhere the greater one (a torus of this kind has major > minor radius),
            // and the directions are those of the parameters: no umbilics, no turning.
            result.certificate.complete = true;
            return true;
        default:
            return false;
    }
}

}  // namespace

FaceUmbilics find_umbilics(const NurbsSurface& surface, const UmbilicOptions& options, const Progress& progress) {
    if (!(options.resolution > 0.0 && options.resolution < 1.0))
        throw InvalidInput("umbilic search: the resolution must lie between 0 and 1");
    if (options.boxes_per_patch < 1) throw InvalidInput("umbilic search: boxes_per_patch must be at least 1");
    if (!(options.generic_margin >= 0.0)) throw InvalidInput("umbilic search: generic_margin must not be negative");
    if (!(options.accuracy >= 0.0)) throw InvalidInput("umbilic search: the accuracy must not be negative");

    const BezierPatches patches = bezier_patches(surface);
    const InputRounding input = input_rounding(surface);
    const std::vector<PatchUmbilics> found = search_patches(surface, patches, input, options, progress);

    FaceUmbilics result;
    std::vector<Candidate> candidates;
    std::vector<OpenPart> open;
    bool collapsed = false;
    result.statistics.patches = static_cast<int>(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        const BezierPatch& patch = patches.patches[k];
        const ParameterBox& domain = patch.domain;
        const CommonZeros& zeros = found[k].zeros;
        result.statistics.formed += found[k].formed;
        result.statistics.boxes += zeros.boxes;
        result.statistics.budget_exhausted = result.statistics.budget_exhausted || zeros.exhausted;
        collapsed = collapsed || found[k].collapsed;
        const auto in_surface = [&](const ParameterBox& box) {
            const auto place = [](const ParameterInterval& whole, const ParameterInterval& part) {
                return ParameterInterval{part.low == 0.0 ? whole.low : whole.low + part.low * whole.length(),
                                         part.high == 1.0 ? whole.high : whole.low + part.high * whole.length()};
            };
            return ParameterBox{place(domain.u, box.u), place(domain.v, box.v)};
        };
        for (const IsolatedZero& zero : zeros.isolated) {
            if (std::optional<Umbilic> umbilic =
                    characterise(surface, patch, zero, input, {options.accuracy, options.generic_margin}))
                candidates.push_back({std::move(*umbilic), zero, k});
            else
                open.push_back({in_surface(zero.box), false});
        }
        for (const OpenBox& part : zeros.open) open.push_back({in_surface(part.box), part.zero});
    }
    merge_duplicates(surface, patches, input, std::move(candidates), result.umbilics, open);
    std::sort(result.umbilics.begin(), result.umbilics.end(),
              [](const Umbilic& a, const Umbilic& b) { return a.at.u != b.at.u ? a.at.u < b.at.u : a.at.v < b.at.v; });
    if (!open.empty()) sort_open_parts(surface, patches, input, open, options, result);
    result.certificate = make_certificate(patches, found, result, options.certificate, collapsed);
    return result;
}

FaceUmbilics find_umbilics(const Face& face, const UmbilicOptions& options, const Progress& progress) {
    FaceUmbilics result;
    if (!answer_elementary(face, result)) {
        UmbilicOptions on_face = options;
        on_face.accuracy += face.conversion_error;
        result = find_umbilics(face.surface, on_face, progress);
    }
    result.face = face.number;
    for (Umbilic& umbilic : result.umbilics) {
        umbilic.at.face = face.number;
        if (!face.region.whole_domain())
            umbilic.containment = face.region.classify(umbilic.at.u, umbilic.at.v, umbilic.radius);
    }
    return result;
}

std::vector<FaceUmbilics> find_umbilics(const Model& model, const UmbilicOptions& options, const Progress& progress) {
    std::vector<FaceUmbilics> result(model.faces.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t(0), model.faces.size(), [&](std::size_t k) {
        progress.check();
        const auto fraction = [&] { return static_cast<double>(done) / static_cast<double>(result.size()); };
        // Faces end in any order, so the fraction is counted in faces; within one it stands still but can be cancelled.
        result[k] = find_umbilics(model.faces[k], options, progress.part(fraction(), fraction()));
        ++done;
        progress.report(fraction(), "umbilics");
    });
    return result;
}

}  // namespace umbilic
