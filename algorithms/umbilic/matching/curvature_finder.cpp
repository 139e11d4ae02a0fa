// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/curvature_finder.h>

#include <oneapi/tbb/parallel_for.h>

#include <umbilic/curvature_points/dependence.h>

namespace umbilic {

namespace {

/// A place of a face, if it is one of the face's.
void add(const Face& face, const CurvaturePosition& position, std::array<std::vector<Curvature>, 2>& solutions) {
    if (!face.region.whole_domain() && face.region.classify(position.u, position.v, 0.0) == Containment::outside)
        return;
    const Curvature there = curvature(face.surface, position.u, position.v);
    if (there.regular) solutions[position.opposite].push_back(face.reversed ? flipped(there) : there);
}

}  // namespace

CurvatureFinder::CurvatureFinder(const Model& model, CurvatureSolver solver, const Progress& progress)
    : solver_(solver) {
    for (const Face& face : model.faces)
        if (!curvature_dependence(face)) faces_.push_back(&face);
    if (solver == CurvatureSolver::approximated)
        for (const Face* face : faces_)
            surfaces_.emplace_back(face->surface, CurvatureSurfaceOptions{}, progress.part(0.0, 0.0));
}

CurvatureSolutions CurvatureFinder::find(std::span<const CurvatureQuery> queries, bool both_signs,
                                         const Progress& progress) const {
    CurvatureSolutions result(queries.size());
    if (solver_ == CurvatureSolver::direct) {
        CurvaturePointOptions options;
        options.both_signs = both_signs;
        options.recognition = 0.0;  // faces_ holds the others
        std::vector<CurvaturePoints> found(faces_.size());
        tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t k) {
            progress.check();
            found[k] = find_curvature_points(*faces_[k], queries, options, progress.part(0.0, 0.0));
        });
        for (const CurvaturePoints& face : found)
            for (const CurvaturePoint& point : face.points)
                if (point.containment != Containment::outside && point.curvature.regular)
                    result[point.query][point.opposite].push_back(point.curvature);
        return result;
    }
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (queries[q].gaussian_tolerance != 0.0) continue;
        for (std::size_t k = 0; k < faces_.size(); ++k) {
            progress.check();
            // The other solvers know the surface and not its outward side.
            CurvatureQuery query = queries[q];
            if (faces_[k]->reversed) query.mean = -query.mean;
            const std::vector<CurvaturePosition> positions =
                solver_ == CurvatureSolver::approximated ? surfaces_[k].find(query, progress)
                                                         : find_curvature_points_by_projected_polyhedron(
                                                               faces_[k]->surface, query, {}, progress.part(0.0, 0.0))
                                                               .points;
            for (const CurvaturePosition& position : positions)
                if (both_signs || !position.opposite) add(*faces_[k], position, result[q]);
        }
    }
    return result;
}

}  // namespace umbilic
