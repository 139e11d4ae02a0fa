// SPDX-License-Identifier: LGPL-2.1-or-later
// Umbilics by the search and, on a mesh of the same surface, by CGAL's Ridges_3 (jets of degree 4 fitted to two rings
// of neighbours, then Umbilic_approximation), one thread. The reference is a third search by sampling, which is not
// timed. "relevant": umbilics whose rings stay off the border, which CGAL leaves out.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Umbilics.h>
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <support/dense_umbilics.h>
#include <support/surfaces.h>
#include <umbilic/umbilics/find.h>

namespace umbilic {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

constexpr int jet_degree = 4;
constexpr int rings = 2;
/// Radius, in rings, in which a vertex must have the least difference of curvatures: CGAL's own default.
constexpr double umbilic_size = 2;
/// A vertex this many edges from an umbilic stands for it.
constexpr double matching_edges = 3.0;

struct Case {
    const char* name;
    NurbsSurface surface;
};

const Case& surface_case(int which) {
    static const std::vector<Case> cases = {{"table 3.1", support::table_3_1_patch()},
                                            {"smooth 20x20", support::smooth_bicubic(20, 7)},
                                            {"rough 8x8", support::rough_bicubic(8, 7)},
                                            {"rough 20x20", support::rough_bicubic(20, 7)}};
    return cases[which];
}

/// Umbilics found, as parameters relative to the domain, beside the reference.
void report(benchmark::State& state, const NurbsSurface& surface, const std::vector<Vector2>& found, double margin,
            double within) {
    const ParameterBox domain = surface.domain();
    const auto relative = [&](const Vector2& at) {
        return Vector2((at.x() - domain.u.low) / domain.u.length(), (at.y() - domain.v.low) / domain.v.length());
    };
    const auto relevant = [&](const Vector2& at) { return at.minCoeff() > margin && at.maxCoeff() < 1 - margin; };
    const auto point = [&](const Vector2& at) {
        return surface.value(domain.u.low + at.x() * domain.u.length(), domain.v.low + at.y() * domain.v.length());
    };
    const double size = surface.pole_box().diagonal();
    std::vector<bool> taken(found.size(), false);
    int wanted = 0, matched = 0;
    double sum = 0.0, largest = 0.0;
    for (const support::SampledUmbilic& reference : support::sample_umbilics(surface).umbilics) {
        const Vector2 at = relative(reference.at);
        const bool counts = relevant(at);
        wanted += counts;
        std::size_t nearest = found.size();
        for (std::size_t k = 0; k < found.size(); ++k)
            if (!taken[k] && (nearest == found.size() || (found[k] - at).norm() < (found[nearest] - at).norm()))
                nearest = k;
        if (nearest == found.size() || (found[nearest] - at).norm() > within) continue;
        taken[nearest] = true;
        if (!counts) continue;
        ++matched;
        const double error = (point(found[nearest]) - point(at)).norm() / size;
        sum += error;
        largest = std::max(largest, error);
    }
    state.counters["relevant"] = wanted;
    state.counters["found"] = matched;
    state.counters["missed"] = wanted - matched;
    state.counters["spurious"] = static_cast<double>(std::count(taken.begin(), taken.end(), false));
    state.counters["mean error"] = matched > 0 ? sum / matched : 0.0;
    state.counters["largest error"] = largest;
    state.SetLabel(surface_case(static_cast<int>(state.range(0))).name);
}

/// Borders of the meshes' rings, so that both searches answer for the same umbilics.
double border_margin(int cells) {
    return (umbilic_size + rings + 1.0) / cells;
}

void search(benchmark::State& state) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const NurbsSurface& surface = surface_case(static_cast<int>(state.range(0))).surface;
    FaceUmbilics umbilics;
    for (auto _ : state) umbilics = find_umbilics(surface);
    const ParameterBox domain = surface.domain();
    std::vector<Vector2> found;
    for (const Umbilic& umbilic : umbilics.umbilics)
        found.emplace_back((umbilic.at.u - domain.u.low) / domain.u.length(),
                           (umbilic.at.v - domain.v.low) / domain.v.length());
    report(state, surface, found, border_margin(static_cast<int>(state.range(1))), 1e-9);
}

/// Vertices within two rings, the vertex itself first.
std::vector<Kernel::Point_3> neighbourhood(const Mesh& mesh, Vertex vertex) {
    std::vector<Vertex> all = {vertex};
    std::size_t ring_start = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const std::size_t ring_end = all.size();
        for (std::size_t k = ring_start; k < ring_end; ++k)
            for (const Vertex next : CGAL::vertices_around_target(mesh.halfedge(all[k]), mesh))
                if (std::find(all.begin(), all.end(), next) == all.end()) all.push_back(next);
        ring_start = ring_end;
    }
    std::vector<Kernel::Point_3> result;
    for (const Vertex v : all) result.push_back(mesh.point(v));
    return result;
}

void cgal(benchmark::State& state) {
    const NurbsSurface& surface = surface_case(static_cast<int>(state.range(0))).surface;
    const int cells = static_cast<int>(state.range(1));
    const ParameterBox domain = surface.domain();
    Mesh mesh;
    std::vector<Vertex> vertices;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) {
            const Vector3 p = surface.value(domain.u.low + domain.u.length() * i / cells,
                                            domain.v.low + domain.v.length() * j / cells);
            vertices.push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
        }
    const auto at = [&](int i, int j) { return vertices[i * (cells + 1) + j]; };
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }

    std::vector<Vector2> found;
    for (auto _ : state) {
        auto k1 = mesh.add_property_map<Vertex, double>("v:k1", 0).first;
        auto k2 = mesh.add_property_map<Vertex, double>("v:k2", 0).first;
        auto d1 = mesh.add_property_map<Vertex, Kernel::Vector_3>("v:d1", Kernel::Vector_3(0, 0, 0)).first;
        auto d2 = mesh.add_property_map<Vertex, Kernel::Vector_3>("v:d2", Kernel::Vector_3(0, 0, 0)).first;
        using Fitting = CGAL::Monge_via_jet_fitting<Kernel>;
        for (const Vertex vertex : mesh.vertices()) {
            const std::vector<Kernel::Point_3> points = neighbourhood(mesh, vertex);
            constexpr std::size_t unknowns = (jet_degree + 1) * (jet_degree + 2) / 2;
            if (points.size() < unknowns) continue;  // corners
            Fitting fitting;
            Fitting::Monge_form monge = fitting(points.begin(), points.end(), jet_degree, 2);
            monge.comply_wrt_given_normal(Kernel::Vector_3(0, 0, 1));
            k1[vertex] = monge.principal_curvatures(0);
            k2[vertex] = monge.principal_curvatures(1);
            d1[vertex] = monge.maximal_principal_direction();
            d2[vertex] = monge.minimal_principal_direction();
        }
        using Approximation = CGAL::Umbilic_approximation<Mesh, decltype(k1), decltype(d1)>;
        Approximation approximation(mesh, k1, k2, d1, d2);
        std::vector<Approximation::Umbilic*> umbilics;
        approximation.compute(std::back_inserter(umbilics), umbilic_size);
        found.clear();
        for (Approximation::Umbilic* umbilic : umbilics) {
            const int number = static_cast<int>(umbilic->vertex());
            found.emplace_back(static_cast<double>(number / (cells + 1)) / cells,
                               static_cast<double>(number % (cells + 1)) / cells);
            delete umbilic;
        }
    }
    report(state, surface, found, border_margin(cells), matching_edges / cells);
}

BENCHMARK(search)->ArgsProduct({{0, 1, 2, 3}, {100}})->Unit(benchmark::kMillisecond);
BENCHMARK(cgal)->ArgsProduct({{0, 1, 2, 3}, {50, 100}})->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(cgal)->Args({3, 200})->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace umbilic
