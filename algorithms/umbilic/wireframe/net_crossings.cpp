// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the lines of a net cross.
#include <umbilic/wireframe/net_builder.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

namespace umbilic {

namespace {

/// The crossing segments of two lines: middle of the one and begin of the other are nearer than this.
constexpr double segment_reach = 0.75;
/// Newton's method on (s1, s2).
constexpr int most_corrections = 12;
constexpr double relative_correction = 1e-11;
/// A crossing this little beyond the end of a line, relative to the step, is on it.
constexpr double relative_end = 1e-6;

}  // namespace

/// Difference of parameters by the short way around where the surface is closed.
Vector2 NetBuilder::difference(Vector2 d) const {
    const Face& face = tracer_.face();
    const ParameterBox domain = face.surface.domain();
    if (face.u_closed || face.u_periodic) d.x() -= domain.u.length() * std::round(d.x() / domain.u.length());
    if (face.v_closed || face.v_periodic) d.y() -= domain.v.length() * std::round(d.y() / domain.v.length());
    return d;
}

/// Newton's method (thesis (3.48)) on the parameters of both lines.
std::optional<std::pair<double, double>> NetBuilder::crossing(const NetLine& a, double sa, const NetLine& b,
                                                              double sb) const {
    for (int i = 0; i < most_corrections; ++i) {
        const Vector2 f = difference(a.at(sa) - b.at(sb));
        Matrix2 jacobian;
        jacobian << a.rate(sa), -b.rate(sb);
        const Vector2 correction = jacobian.fullPivLu().solve(f);
        if (!correction.allFinite() || correction.norm() > step_) return std::nullopt;
        sa -= correction.x();
        sb -= correction.y();
        if (correction.norm() > relative_correction * step_) continue;
        const auto within = [&](const NetLine& line, double s) {
            const double slack = line.closed ? same_crossing * step_ : relative_end * step_;
            return s >= line.low - slack && s <= line.high + slack;
        };
        return within(a, sa) && within(b, sb) ? std::optional(std::pair(sa, sb)) : std::nullopt;
    }
    return std::nullopt;
}

void NetBuilder::add_crossing(int a, double sa, int b, double sb) {
    // A crossing is found from the segments on both sides of it; closed lines meet theirs at both ends.
    for (const auto& [line, at] : {std::pair(&lines_[a], &sa), std::pair(&lines_[b], &sb)})
        if (line->closed && *at > line->high - same_crossing * step_) *at -= line->high;
    const auto known = [&](const NetLine& line, double s) {
        const auto above = line.crossings.lower_bound(s - same_crossing * step_);
        return above != line.crossings.end() && above->first < s + same_crossing * step_;
    };
    if (known(lines_[a], sa) && known(lines_[b], sb)) return;
    const Vector2 p = tracer_.wrapped(lines_[a].at(sa));
    const int node = static_cast<int>(net_.nodes.size());
    const auto distance = [](const NetLine& line, double s) {
        return line.distance + (line.closed ? std::min(std::abs(s), std::abs(line.high - s)) : std::abs(s));
    };
    net_.nodes.push_back(
        {p, tracer_.face().surface.value(p.x(), p.y()), std::min(distance(lines_[a], sa), distance(lines_[b], sb))});
    lines_[a].crossings.emplace(sa, node);
    lines_[b].crossings.emplace(sb, node);
    lines_[a].changed = lines_[b].changed = true;
}

void NetBuilder::find_crossings(int number) {
    const NetLine& line = lines_[number];
    const SampleGrid& grid = grids_[1 - index(line.family)];
    // First guesses by segments between samples; then exactly.
    std::vector<std::tuple<double, int, double>> guesses;
    for (std::size_t i = 0; i + 1 < line.samples.size(); ++i) {
        const NetSample &p = line.samples[i], &q = line.samples[i + 1];
        const Vector3 d = q.point - p.point;
        grid.near(0.5 * (p.point + q.point), segment_reach * step_, [&](const SampleEntry& entry) {
            const NetLine& across = lines_[entry.line];
            if (entry.sample + 1 >= static_cast<int>(across.samples.size())) return;
            const NetSample &r = across.samples[entry.sample], &t = across.samples[entry.sample + 1];
            if (p.normal.dot(r.normal) < same_side) return;
            // Nearest points of the two segments' lines.
            const Vector3 e = t.point - r.point, w = p.point - r.point;
            const double dd = d.dot(d), de = d.dot(e), ee = e.dot(e), dw = d.dot(w), ew = e.dot(w);
            const double determinant = dd * ee - de * de;
            if (!(determinant > 0.01 * dd * ee)) return;
            const double x = (de * ew - ee * dw) / determinant, y = (dd * ew - de * dw) / determinant;
            if (x < -0.1 || x > 1.1 || y < -0.1 || y > 1.1) return;
            if ((w + x * d - y * e).norm() > 0.25 * std::sqrt(dd + ee)) return;
            guesses.emplace_back(p.s + x * (q.s - p.s), entry.line, r.s + y * (t.s - r.s));
        });
    }
    std::sort(guesses.begin(), guesses.end());
    for (const auto& [s, across, t] : guesses)
        if (const auto exact = crossing(lines_[number], s, lines_[across], t))
            add_crossing(number, exact->first, across, exact->second);
}

}  // namespace umbilic
