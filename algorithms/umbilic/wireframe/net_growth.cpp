// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the lines of a net go.
#include <umbilic/wireframe/net_builder.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace umbilic {

namespace {

/// A line ends where another one of its family is nearer than this, and may begin where none is nearer than that.
constexpr double least_distance = 0.537;
constexpr double least_start_distance = 0.713;
/// A line is compared with parts of itself that are farther away along it; no multiple of the samples' distance.
constexpr double own_distance = 2.113;
/// Lines are parallel if the cosine between them is above this.
constexpr double parallel = 0.707;
/// Error of a step of the integration, relative to the step of the net.
constexpr double relative_tolerance = 1e-7;
/// A line ends after this many steps of the net at the latest.
constexpr double longest_line = 400.0;
constexpr std::size_t most_line_steps = 40'000;

}  // namespace

TraceOptions NetBuilder::trace_options() const {
    return {.length = longest_line * step_,
            .tolerance = relative_tolerance * step_,
            .longest_step = step_,
            .closing_distance = 1e-3 * step_,
            .most_steps = most_line_steps};
}

/// Whether a sample of another line, across of it, is nearer than `distance`: lines are compared where they run side by
/// side on one side of the surface.
bool NetBuilder::near(const NetSample& sample, const NetLine& line, int number, double distance) const {
    const NetSample& other = line.samples[number];
    if (sample.normal.dot(other.normal) < same_side || std::abs(sample.tangent.dot(other.tangent)) < parallel)
        return false;
    const Vector3 d = sample.point - other.point;
    const double along = d.dot(other.tangent), reach = sample_reach * step_;
    const bool inner = number > 0 && number + 1 < static_cast<int>(line.samples.size());
    if (inner && std::abs(along) > reach) return false;
    return (d - std::clamp(along, -reach, reach) * other.tangent).norm() < distance;
}

bool NetBuilder::crowded(const NetSample& sample, CurvatureFamily family, double distance) const {
    bool found = false;
    grids_[index(family)].near(sample.point, distance + sample_reach * step_, [&](const SampleEntry& entry) {
        found = found || near(sample, lines_[entry.line], entry.sample, distance);
    });
    return found;
}

void NetBuilder::sample(NetLine& line) const {
    const double spacing = sample_share * step_;
    const auto add = [&](double s) {
        const Vector2 p = line.at(s);
        const FieldValue value = tracer_.value(tracer_.wrapped(p), line.family);
        const Vector2 rate = line.rate(s);
        line.samples.push_back({s, tracer_.wrapped(p), value.point,
                                (value.r_u * rate.x() + value.r_v * rate.y()).normalized(), value.normal});
    };
    if (line.closed) {
        // The same to both sides of the seed, whichever way the line was traced.
        const double half = 0.5 * line.high;
        const int each = static_cast<int>(std::floor(half / spacing));
        for (int i = 0; i <= each; ++i) add(i * spacing);
        if (half - each * spacing > 0.5 * spacing) add(half);
        for (int i = each; i >= 0; --i) add(line.high - i * spacing);
        return;
    }
    const int below = static_cast<int>(std::floor(-line.low / spacing)),
              above = static_cast<int>(std::floor(line.high / spacing));
    if (line.low < -below * spacing - 1e-9 * step_) add(line.low);
    for (int i = -below; i <= above; ++i) add(i * spacing);
    if (line.high > above * spacing + 1e-9 * step_) add(line.high);
}

std::optional<NetLine> NetBuilder::trace(const NetSeed& seed) const {
    const FieldValue value = tracer_.value(seed.parameters, seed.family);
    if (tracer_.indeterminate(value)) return std::nullopt;
    const auto as_sample = [](const FieldValue& v) -> NetSample { return {0.0, {}, v.point, v.tangent, v.normal}; };
    if (crowded(as_sample(value), seed.family, least_start_distance * step_)) return std::nullopt;
    TraceOptions options = trace_options();
    // The integration need not go on where the line will be cut anyway, nor, along an axis, where lines of that family
    // meet and one would go straight over. That is asked at the line's samples, whatever the steps, which depend on
    // knots.
    options.stop_spacing = sample_share * step_;
    Vector3 before = value.normal;
    options.stop = [&](const FieldValue& v) {
        const double turn = std::atan2(before.cross(v.normal).norm(), before.dot(v.normal));
        before = v.normal;
        return crowded(as_sample(v), seed.family, least_distance * step_) || (tracer_.along_axis() && v.spread < turn);
    };
    NetLine line;
    line.family = seed.family;
    line.distance = seed.distance;
    line.overlap = same_crossing * step_;
    line.ahead = tracer_.trace(seed.parameters, seed.family, seed.one_way.value_or(value.tangent), options, progress_);
    line.closed = line.ahead.ended == CurveEnd::closed;
    before = value.normal;
    if (!seed.one_way && !line.closed)
        line.behind = tracer_.trace(seed.parameters, seed.family, -value.tangent, options, progress_);
    // All of the line may lie behind: then it is turned around.
    if (line.ahead.steps.empty()) std::swap(line.ahead, line.behind);
    line.high = line.ahead.steps.empty() ? 0.0 : line.ahead.stopped.value_or(line.ahead.length);
    line.low = line.behind.steps.empty() ? 0.0 : -line.behind.stopped.value_or(line.behind.length);
    if (!(line.high - line.low > sample_share * step_)) return std::nullopt;
    sample(line);
    return line;
}

/// Lets lines grow from their seeds at the same pace, and ends each where it comes near to a line of its family that
/// was there before. What reaches a place first does not depend on the order of the lines.
void NetBuilder::grow(std::vector<NetLine>& lines) const {
    const double distance = least_distance * step_;
    // Samples by their way along the line from the seed; a closed line grows to both sides as far as its middle.
    struct Event {
        double pace;
        int line, sample;
        bool ahead;
    };
    std::vector<Event> events;
    // Where each side of a line ends: the last sample on it.
    struct Ends {
        int high, low;
        bool high_cut = false, low_cut = false;
    };
    std::vector<Ends> ends;
    for (std::size_t l = 0; l < lines.size(); ++l) {
        const int count = static_cast<int>(lines[l].samples.size());
        const auto is_ahead = [&](const NetSample& x) {
            return x.s >= 0.0 && !(lines[l].closed && x.s > 0.5 * lines[l].high);
        };
        Ends& own = ends.emplace_back(Ends{0, count - 1});
        for (int i = 0; i < count; ++i) {
            const double s = lines[l].samples[i].s;
            const bool ahead = is_ahead(lines[l].samples[i]);
            if (ahead)
                own.high = std::max(own.high, i);
            else
                own.low = std::min(own.low, i);
            events.push_back(
                {lines[l].closed && !ahead ? lines[l].high - s : std::abs(s), static_cast<int>(l), i, ahead});
        }
    }
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.pace < b.pace; });
    std::array<SampleGrid, 2> grown = {SampleGrid(cell_side * step_), SampleGrid(cell_side * step_)};
    for (std::size_t begin = 0; begin < events.size();) {
        std::size_t end = begin;
        while (end < events.size() && events[end].pace <= events[begin].pace + tie * step_) ++end;
        std::vector<Event> reached;
        for (std::size_t e = begin; e < end; ++e) {
            const Event& event = events[e];
            const NetLine& line = lines[event.line];
            const NetSample& sample = line.samples[event.sample];
            Ends& own = ends[event.line];
            if (event.ahead ? event.sample > own.high : event.sample < own.low) continue;
            const bool is_seed = event.pace <= tie * step_;
            bool stop = !is_seed && crowded(sample, line.family, distance);
            if (!is_seed)
                grown[index(line.family)].near(
                    sample.point, distance + sample_reach * step_, [&](const SampleEntry& entry) {
                        if (stop) return;
                        const NetLine& other = lines[entry.line];
                        if (entry.line == event.line) {
                            double between = std::abs(other.samples[entry.sample].s - sample.s);
                            if (line.closed) between = std::min(between, line.high - between);
                            if (between < own_distance * step_) return;
                        }
                        stop = near(sample, other, entry.sample, distance);
                    });
            reached.push_back(event);
            if (!stop) continue;
            (event.ahead ? own.high : own.low) = event.sample;
            (event.ahead ? own.high_cut : own.low_cut) = true;
        }
        for (const Event& event : reached)
            grown[index(lines[event.line].family)].add(lines[event.line].samples[event.sample].point,
                                                       {event.line, event.sample});
        begin = end;
    }
    for (std::size_t l = 0; l < lines.size(); ++l) {
        NetLine& line = lines[l];
        const Ends& own = ends[l];
        const std::vector<NetSample> all = std::move(line.samples);
        line.samples.clear();
        if (line.closed && !own.high_cut && !own.low_cut) {
            line.samples = all;
            continue;
        }
        // Of a closed line two branches remain; the sample after a whole turn is the seed's.
        for (int i = own.low; i < static_cast<int>(all.size()); ++i) {
            NetSample sample = all[i];
            if (line.closed) sample.s -= line.high;
            if (sample.s < -1e-9 * step_) line.samples.push_back(sample);
        }
        for (int i = 0; i <= own.high; ++i)
            if (all[i].s >= 0.0) line.samples.push_back(all[i]);
        line.opened = line.closed;
        line.closed = false;
        line.low = line.samples.front().s;
        line.high = line.samples.back().s;
    }
}

}  // namespace umbilic
