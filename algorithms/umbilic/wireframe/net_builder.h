// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <umbilic/wireframe/line_net.h>
#include <umbilic/wireframe/net_line.h>
#include <umbilic/wireframe/point_cells.h>

namespace umbilic {

// All factors of the step are chosen off simple fractions, so that models with round measures are not undecided.

/// Sample of a line, by their numbers.
struct SampleEntry {
    int line, sample;
};
using SampleGrid = PointCells<SampleEntry>;

/// The work of line_net(): where lines shall start (line_net.cpp), how far they go (net_growth.cpp), where they cross
/// (net_crossings.cpp).
class NetBuilder {
public:
    NetBuilder(const LineTracer& tracer, const LineNetOptions& options, const Progress& progress)
        : tracer_(tracer),
          options_(options),
          progress_(progress),
          step_(options.step),
          grids_{SampleGrid(cell_side * step_), SampleGrid(cell_side * step_)} {}

    LineNet build(const NetStart& start);

private:
    /// Lines are sampled at this part of the step.
    static constexpr double sample_share = 0.25;
    /// A sample stands for this much of its line to both sides, relative to the step: a little more than half of it.
    static constexpr double sample_reach = 0.51 * sample_share;
    /// Cells of samples, relative to the step: about two along each axis hold what is asked for.
    static constexpr double cell_side = 1.5;
    /// Lines are on one side of the surface if the cosine between its normals is above this.
    static constexpr double same_side = 0.3;
    /// Crossings of two lines that are nearer along them than this are one.
    static constexpr double same_crossing = 0.01;
    /// Lengths that differ by less than this share of the step are equal.
    static constexpr double tie = 1e-4;

    static int index(CurvatureFamily family) { return family == CurvatureFamily::maximum ? 0 : 1; }
    static CurvatureFamily other(CurvatureFamily family) {
        return family == CurvatureFamily::maximum ? CurvatureFamily::minimum : CurvatureFamily::maximum;
    }
    TraceOptions trace_options() const;
    bool crowded(const NetSample& sample, CurvatureFamily family, double distance) const;
    bool near(const NetSample& sample, const NetLine& line, int number, double distance) const;
    std::optional<NetLine> trace(const NetSeed& seed) const;
    bool add_lines(const std::vector<NetSeed>& seeds);
    void sample(NetLine& line) const;
    void grow(std::vector<NetLine>& lines) const;
    void find_crossings(int number);
    std::optional<std::pair<double, double>> crossing(const NetLine& a, double sa, const NetLine& b, double sb) const;
    void add_crossing(int a, double sa, int b, double sb);
    std::vector<NetSeed> seeds_of(int number) const;
    void refuse(const NetSeed& seed);
    Vector2 difference(Vector2 d) const;

    const LineTracer& tracer_;
    const LineNetOptions& options_;
    const Progress& progress_;
    double step_;
    std::vector<NetLine> lines_;
    std::array<SampleGrid, 2> grids_;
    LineNet net_;
};

}  // namespace umbilic
