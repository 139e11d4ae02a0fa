// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <umbilic/wireframe/completion.h>
#include <umbilic/wireframe/face_triangulation.h>
#include <umbilic/wireframe/point_cells.h>

namespace umbilic {

/// The work of complete(): border and net as a triangulation (completion.cpp), further nodes (completion_nodes.cpp),
/// edges and cells (completion_cells.cpp).
class FaceCompletion {
public:
    FaceCompletion(const Face& face, const FaceBorder& border, const FaceFrame& frame, const LineNet& net,
                   const LineField& field, const CompletionOptions& options, const Progress& progress)
        : face_(face),
          border_(border),
          frame_(frame),
          net_(net),
          field_(field),
          options_(options),
          progress_(progress),
          border_segments_(std::max(options.step, 1e-300)) {}

    Completion run();

private:
    /// Of triangles, or crossings, that differ by less than this share, the one that the face's frame prefers comes
    /// first.
    static constexpr double preference_share = 1e-3;

    struct Vertex {
        Vector2 parameters;
        bool on_border = false;
    };

    GridPoint to_grid(const Vector2& p) const {
        const auto coordinate = [](double x, const ParameterInterval& range) {
            return static_cast<std::int64_t>(
                std::llround((x - range.low) / range.length() * static_cast<double>(grid_side)));
        };
        return {coordinate(p.x(), box_.u), coordinate(p.y(), box_.v)};
    }
    Vector2 from_grid(double x, double y) const {
        return {box_.u.low + box_.u.length() * x / static_cast<double>(grid_side),
                box_.v.low + box_.v.length() * y / static_cast<double>(grid_side)};
    }
    Vector2 wrapped(Vector2 p) const;
    bool build_border(Completion& result);
    void add_net();
    void remove_seam();
    bool refine();
    std::optional<Vector2> circumcentre(int triangle) const;
    std::optional<Vector2> edge_middle(int slot) const;
    std::optional<Vector2> solve(Vector2 p, const Vector3& n1, double d1, const Vector3& n2, double d2,
                                 double reach) const;
    double border_distance(const Vector3& p) const;
    int add_vertex(const FaceTriangulation::Place& place, const Vector2& p, const Vector3& point);
    FaceWireframe assemble() const;
    void measure(FaceWireframe& wireframe, const std::vector<int>& node_of) const;

    const Face& face_;
    const FaceBorder& border_;
    const FaceFrame& frame_;
    const LineNet& net_;
    const LineField& field_;
    const CompletionOptions& options_;
    const Progress& progress_;

    ParameterBox box_;
    bool u_closed_ = false, v_closed_ = false;
    FaceTriangulation mesh_;
    std::vector<Vertex> vertices_;
    std::vector<int> net_vertex_;
    struct Segment {
        Vector3 a, b;
    };
    PointCells<Segment> border_segments_;
    bool exhausted_ = false;
};

}  // namespace umbilic
