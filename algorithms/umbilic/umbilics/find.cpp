// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/find.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <umbilic/core/errors.h>
#include <umbilic/nurbs/bezier_patch.h>
#include <umbilic/umbilics/characterise.h>
#include <umbilic/umbilics/clusters.h>
#include <umbilic/umbilics/duplicates.h>
#include <umbilic/umbilics/certificate.h>
#include <umbilic/umbilics/known_kinds.h>
#include <umbilic/umbilics/lines.h>
#include <umbilic/umbilics/patch_search.h>
#include <umbilic/umbilics/poles.h>
#include <umbilic/umbilics/regions.h>
#include <umbilic/umbilics/winding.h>

namespace umbilic {

namespace {

/// Boxes are split down to this share of their patch however small the patch is: the resolution is relative to the
/// whole domain, and a narrow patch needs some boxes of its own.
constexpr double coarsest_patch_size = 1.0 / 16;
/// Radius of an umbilic, relative to the domain, above which its place is improved in precise arithmetic.
constexpr double wanted_radius = 2e-11;
/// Points beside a pole that are looked at to tell whether it belongs to a face, and their distance from it relative to
/// the domain: beyond the accuracy of the loops.
constexpr int pole_samples = 16;
constexpr double pole_distance = 10 * TrimmingRegion::polyline_deviation;

/// Breaks across which the surface is less than twice continuously differentiable, and the two ends of what is
/// searched: borders of blocks on which the principal directions are continuous.
std::vector<bool> block_borders(const KnotVector& knots, int first, int last) {
    std::vector<bool> result(knots.breaks().size());
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = knots.continuity(static_cast<int>(k)) < 2;
    result[first] = result[last] = true;
    return result;
}

/// Entries of patches outside of `range` stay empty.
std::vector<PatchUmbilics> search_patches(const NurbsSurface& surface, const BezierPatches& patches,
                                          const InputRounding& input, const PatchRange& range,
                                          const UmbilicOptions& options, const Progress& progress) {
    const ParameterBox domain = surface.domain();
    const std::vector<bool> u_border = block_borders(surface.u_knots(), range.u_first, range.u_last);
    const std::vector<bool> v_border = block_borders(surface.v_knots(), range.v_first, range.v_last);
    std::vector<PatchUmbilics> result(patches.patches.size());
    const std::size_t columns = range.v_last - range.v_first;
    const std::size_t count = (range.u_last - range.u_first) * columns;
    tbb::enumerable_thread_specific<PatchSearch> searches;
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& part) {
        PatchSearch& search = searches.local();
        for (std::size_t at = part.begin(); at != part.end(); ++at) {
            progress.check();
            const std::size_t i = range.u_first + at / columns, j = range.v_first + at % columns;
            const std::size_t k = i * patches.v_count + j;
            const BezierPatch& patch = patches.patches[k];
            PatchTask task;
            task.limits.u_size =
                std::min(coarsest_patch_size, options.resolution * domain.u.length() / patch.domain.u.length());
            task.limits.v_size =
                std::min(coarsest_patch_size, options.resolution * domain.v.length() / patch.domain.v.length());
            task.limits.boxes = options.boxes_per_patch;
            task.limits.u_radius = wanted_radius * domain.u.length() / patch.domain.u.length();
            task.limits.v_radius = wanted_radius * domain.v.length() / patch.domain.v.length();
            if (options.certificate) task.edges = {u_border[i], u_border[i + 1], v_border[j], v_border[j + 1]};
            result[k] = search.search(surface, patch, input, task, progress);
        }
        done += part.size();
        progress.report(static_cast<double>(done) / static_cast<double>(count), "umbilics");
    });
    return result;
}

/// Of every isolated zero, patch after patch.
std::vector<std::optional<Umbilic>> characterise_all(const NurbsSurface& surface, const BezierPatches& patches,
                                                     const InputRounding& input,
                                                     const std::vector<PatchUmbilics>& found,
                                                     const InputAccuracy& accuracy) {
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t k = 0; k < found.size(); ++k)
        for (std::size_t i = 0; i < found[k].zeros.isolated.size(); ++i) places.emplace_back(k, i);
    std::vector<std::optional<Umbilic>> result(places.size());
    tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t at) {
        const auto [k, i] = places[at];
        result[at] = characterise(surface, patches.patches[k], found[k].zeros.isolated[i], input, accuracy);
    });
    return result;
}

void check(const UmbilicOptions& options) {
    if (!(options.resolution > 0.0 && options.resolution < 1.0))
        throw InvalidInput("umbilic search: the resolution must lie between 0 and 1");
    if (options.boxes_per_patch < 1) throw InvalidInput("umbilic search: boxes_per_patch must be at least 1");
    if (!(options.generic_margin >= 0.0)) throw InvalidInput("umbilic search: generic_margin must not be negative");
    if (!(options.accuracy >= 0.0)) throw InvalidInput("umbilic search: the accuracy must not be negative");
    if (!(options.recognition >= 0.0)) throw InvalidInput("umbilic search: recognition must not be negative");
}

/// Boxes on which the search proved nothing.
std::vector<ParameterBox> left_open(const FaceUmbilics& found) {
    std::vector<ParameterBox> result;
    const auto add = [&](const std::vector<ParameterBox>& boxes) {
        result.insert(result.end(), boxes.begin(), boxes.end());
    };
    for (const UmbilicLine& line : found.lines) add(line.boxes);
    for (const UndecidedCluster& cluster : found.undecided) add(cluster.boxes);
    for (const UmbilicRegion& region : found.regions) {
        add(region.boxes);
        add(region.border);
    }
    return result;
}

FaceUmbilics search_range(const NurbsSurface& surface, const PatchRange& range, const UmbilicOptions& options,
                          const Progress& progress) {
    const BezierPatches patches = bezier_patches(surface);
    const InputRounding input = input_rounding(surface);
    const std::vector<PatchUmbilics> found = search_patches(surface, patches, input, range, options, progress);

    FaceUmbilics result;
    const std::vector<double>&u_breaks = surface.u_knots().breaks(), &v_breaks = surface.v_knots().breaks();
    result.searched = {{u_breaks[range.u_first], u_breaks[range.u_last]},
                       {v_breaks[range.v_first], v_breaks[range.v_last]}};
    result.statistics.patches = (range.u_last - range.u_first) * (range.v_last - range.v_first);
    std::vector<std::optional<Umbilic>> characterised =
        characterise_all(surface, patches, input, found, {options.accuracy, options.generic_margin});
    std::size_t at = 0;
    std::vector<Candidate> candidates;
    std::vector<OpenPart> open;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const BezierPatch& patch = patches.patches[k];
        const ParameterBox& domain = patch.domain;
        const CommonZeros& zeros = found[k].zeros;
        result.statistics.formed += found[k].formed;
        result.statistics.boxes += zeros.boxes;
        result.statistics.budget_exhausted = result.statistics.budget_exhausted || zeros.exhausted;
        const auto in_surface = [&](const ParameterBox& box) {
            const auto place = [](const ParameterInterval& whole, const ParameterInterval& part) {
                return ParameterInterval{part.low == 0.0 ? whole.low : whole.low + part.low * whole.length(),
                                         part.high == 1.0 ? whole.high : whole.low + part.high * whole.length()};
            };
            return ParameterBox{place(domain.u, box.u), place(domain.v, box.v)};
        };
        for (const IsolatedZero& zero : zeros.isolated) {
            std::optional<Umbilic>& umbilic = characterised[at++];
            if (umbilic)
                candidates.push_back({std::move(*umbilic), zero, k});
            else
                open.push_back({in_surface(zero.box), false});
        }
        for (const OpenBox& part : zeros.open) open.push_back({in_surface(part.box), part.zero});
    }
    std::vector<SightedUmbilic> sighted = merge_duplicates(surface, patches, input, std::move(candidates), open);
    std::vector<Pole> poles = find_poles(surface, patches, input, range, found, sighted, options.generic_margin, open);
    for (const SightedUmbilic& umbilic : sighted) result.umbilics.push_back(umbilic.umbilic);
    for (const Pole& pole : poles)
        if (pole.umbilic) result.umbilics.push_back(*pole.umbilic);
    std::sort(result.umbilics.begin(), result.umbilics.end(),
              [](const Umbilic& a, const Umbilic& b) { return a.at.u != b.at.u ? a.at.u < b.at.u : a.at.v < b.at.v; });
    if (!open.empty()) sort_open_parts(surface, patches, input, open, options, result);
    if (options.certificate)
        result.certificate =
            certify(border_winding(surface, patches, input, range, found, sighted, poles, left_open(result)), result);
    else
        result.certificate.why = "not asked for";
    return result;
}

PatchRange whole_range(const NurbsSurface& surface) {
    return {0, static_cast<int>(surface.u_knots().breaks().size()) - 1, 0,
            static_cast<int>(surface.v_knots().breaks().size()) - 1};
}

/// The patches that `box` meets.
PatchRange range_of(const NurbsSurface& surface, const ParameterBox& box) {
    const auto first = [](const std::vector<double>& breaks, double low) {
        const auto at = std::lower_bound(breaks.begin(), breaks.end(), low);
        return std::clamp(static_cast<int>(at - breaks.begin()) - 1, 0, static_cast<int>(breaks.size()) - 2);
    };
    const auto last = [](const std::vector<double>& breaks, double high) {
        const auto at = std::upper_bound(breaks.begin(), breaks.end(), high);
        return std::clamp(static_cast<int>(at - breaks.begin()), 1, static_cast<int>(breaks.size()) - 1);
    };
    const std::vector<double>&u = surface.u_knots().breaks(), &v = surface.v_knots().breaks();
    return {first(u, box.u.low), last(u, box.u.high), first(v, box.v.low), last(v, box.v.high)};
}

/// What the loops bound, widened by what is not known of them.
ParameterBox searched_box(const TrimmingRegion& region) {
    const ParameterBox domain = region.domain();
    const double u = TrimmingRegion::polyline_deviation * domain.u.length();
    const double v = TrimmingRegion::polyline_deviation * domain.v.length();
    const ParameterBox box = region.box();
    return {{box.u.low - u, box.u.high + u}, {box.v.low - v, box.v.high + v}};
}

/// Where an umbilic lies in its face. The sides of a whole domain are borders unless the surface closes there.
Containment containment(const Face& face, const Umbilic& umbilic) {
    const Containment place = face.region.classify(umbilic.at.u, umbilic.at.v, umbilic.radius);
    if (!face.region.whole_domain() || place == Containment::inside) return place;
    const ParameterBox domain = face.surface.domain();
    const auto at_end = [&](const ParameterInterval& interval, double value) {
        return std::min(value - interval.low, interval.high - value) <= umbilic.radius * interval.length();
    };
    const bool u_border = at_end(domain.u, umbilic.at.u) && !face.u_closed;
    const bool v_border = at_end(domain.v, umbilic.at.v) && !face.v_closed;
    return u_border || v_border ? Containment::boundary : Containment::inside;
}

/// A pole belongs to the face with the points around it.
Containment pole_containment(const Face& face, const Umbilic& umbilic) {
    const ParameterBox domain = face.surface.domain();
    const bool across_u = umbilic.box.u.length() == 0.0;
    int inside = 0;
    for (int k = 0; k < pole_samples; ++k) {
        const double share = (k + 0.5) / pole_samples;
        const auto beside = [&](const ParameterInterval& interval, double end) {
            return end + pole_distance * (interval.low + interval.high - 2 * end);
        };
        const double u = across_u ? beside(domain.u, umbilic.at.u) : umbilic.box.u.low + share * umbilic.box.u.length();
        const double v = across_u ? umbilic.box.v.low + share * umbilic.box.v.length() : beside(domain.v, umbilic.at.v);
        inside += face.region.classify(u, v) == Containment::inside;
    }
    if (inside == 0) return Containment::outside;
    return inside == pole_samples && umbilic.pole == PoleKind::inner ? Containment::inside : Containment::boundary;
}

}  // namespace

FaceUmbilics find_umbilics(const NurbsSurface& surface, const UmbilicOptions& options, const Progress& progress) {
    check(options);
    return search_range(surface, whole_range(surface), options, progress);
}

FaceUmbilics find_umbilics(const Face& face, const UmbilicOptions& options, const Progress& progress) {
    check(options);
    std::optional<FaceUmbilics> known = known_umbilics(face, options);
    FaceUmbilics result;
    if (known) {
        result = std::move(*known);
    } else {
        UmbilicOptions on_face = options;
        on_face.accuracy += face.conversion_error;
        const PatchRange range =
            face.region.whole_domain() ? whole_range(face.surface) : range_of(face.surface, searched_box(face.region));
        result = search_range(face.surface, range, on_face, progress);
    }
    result.face = face.number;
    for (Umbilic& umbilic : result.umbilics) {
        umbilic.at.face = face.number;
        // A pole is an end of the domain, but an inner point of the face if the loops leave it so.
        if (umbilic.pole == PoleKind::none)
            umbilic.containment = containment(face, umbilic);
        else if (!face.region.whole_domain())
            umbilic.containment = pole_containment(face, umbilic);
    }
    if (known || face.region.whole_domain()) return result;
    for (UmbilicLine& line : result.lines) line.containment = containment(face.region, line);
    for (UmbilicRegion& region : result.regions) trim(face.surface, face.region, region);
    std::erase_if(result.regions, [](const UmbilicRegion& region) { return region.boundary.empty(); });
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
