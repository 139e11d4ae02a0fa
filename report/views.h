// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <umbilic/points/least_squares_surface.h>

#include <report/scene.h>

namespace umbilic {

/// A picture with its caption.
struct View {
    std::string caption;
    std::string png;
};

/// The suspect in the pose found, coloured by the size of its deviation, with umbilics, from four sides.
std::vector<View> deviation_views(const Scene& scene);

/// Each model alone, as its file has it: original, suspect.
std::vector<View> model_views(const Scene& scene, const SimilarityTransform& suspect_original);

/// One picture a test (distance, kappa_max, kappa_min, direction): nodes within the tolerance and beyond.
std::vector<View> test_views(const Scene& scene, const Assessment& assessment);

/// The original with the nodes and lines of its wireframe, from two sides; none without a wireframe.
std::vector<View> wireframe_views(const Scene& scene);

/// A model with its isolated umbilics, lines of umbilics and the directions of lines of curvature, from four sides.
std::vector<View> umbilics_views(const SceneMesh& mesh, const std::vector<FaceUmbilics>& umbilics);

/// A fitted surface with its points, coloured by their signed distance, from four sides.
std::vector<View> residual_views(const NurbsSurface& surface, const std::vector<ParametrisedPoint>& points,
                                 const std::vector<double>& distances, const ColorScale& scale);

/// Colours of the nodes in test_views().
extern const Color color_within;
extern const Color color_beyond;

}  // namespace umbilic
