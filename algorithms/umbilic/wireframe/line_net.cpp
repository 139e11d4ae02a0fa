// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/wireframe/line_net.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <umbilic/wireframe/point_cells.h>

namespace umbilic {

namespace {

// All factors of the step are chosen off simple fractions, so that models with round measures are not undecided.

/// A line ends where another one of its family is nearer than this, and may begin where none is nearer than that.
constexpr double least_distance = 0.537;
constexpr double least_start_distance = 0.713;
/// A line is compared with parts of itself that are farther away along it; no multiple of the samples' distance.
constexpr double own_distance = 2.113;
/// A line without a crossing for longer than this gets a new one: at its end, or in the middle between two.
constexpr double longest_end = 1.313;
constexpr double longest_gap = 1.672;
/// Lines are sampled at this part of the step.
constexpr double sample_share = 0.25;
/// A sample stands for this much of its line to both sides, relative to the step: a little more than half of it.
constexpr double sample_reach = 0.51 * sample_share;
/// Cells of samples, relative to the step: about two along each axis hold what is asked for.
constexpr double cell_side = 1.5;
/// The crossing segments of two lines: middle of the one and begin of the other are nearer than this.
constexpr double segment_reach = 3 * sample_share;
/// Lines are parallel if the cosine between them is above this, on one side of the surface if that of the normals is.
constexpr double parallel = 0.707;
constexpr double same_side = 0.3;
/// Error of a step of the integration, relative to the step of the net.
constexpr double relative_tolerance = 1e-7;
/// A line ends after this many steps of the net at the latest.
constexpr double longest_line = 400.0;
constexpr std::size_t most_line_steps = 40'000;
/// Newton's method on (s1, s2).
constexpr int most_corrections = 12;
constexpr double relative_correction = 1e-11;
/// A crossing this little beyond the end of a line, relative to the step, is on it.
constexpr double relative_end = 1e-6;
/// Crossings of two lines that are nearer along them than this are one.
constexpr double same_crossing = 0.01;

/// Lengths that differ by less than this share of the step are equal.
constexpr double tie = 1e-4;
/// Points between neighbouring crossings.
constexpr int between_points = 3;

struct Sample {
    double s = 0.0;  ///< signed arc length from the line's seed
    Vector2 parameters;
    Vector3 point, tangent, normal;
};

/// A place where a line shall start.
struct Seed {
    double distance = 0.0;  ///< from the start of the net, along lines, mm
    Vector2 parameters = Vector2::Zero();
    CurvatureFamily family = CurvatureFamily::maximum;
    std::optional<Vector3> one_way;
    int line = -1;  ///< that it shall cross, at the arc length s
    double s = 0.0;
};

struct Line {
    CurvatureFamily family = CurvatureFamily::maximum;
    TracedLine ahead, behind;
    bool closed = false;
    double low = 0.0, high = 0.0;     ///< arc lengths of its ends
    double distance = 0.0;            ///< of its seed from the start, along lines
    std::vector<Sample> samples;      ///< increasing s
    std::map<double, int> crossings;  ///< node by arc length
    std::vector<double> refused;      ///< arc lengths at which a line was tried
    bool opened = false;              ///< was closed and has been cut
    std::vector<Seed> seeds;          ///< where lines that cross it are missing
    bool changed = true;              ///< since `seeds` were found
    double overlap = 0.0;             ///< mm: a closed line is followed so far beyond its ends

    /// Parameters at the signed arc length s; a little beyond its ends the line goes straight on.
    Vector2 at(double s) const {
        const auto [step, x, over] = locate(s);
        return step->at(x) + over * step->rate(x);
    }
    /// Their derivative by s.
    Vector2 rate(double s) const {
        const auto [step, x, over] = locate(s);
        return (on_ahead(s) ? 1.0 : -1.0) * step->rate(x);
    }

private:
    bool on_ahead(double s) const { return closed || opened || s >= 0.0 || behind.steps.empty(); }

    /// The step that holds s, the fraction of it, and the arc length beyond its end, along the part's own direction.
    std::tuple<const TracedStep*, double, double> locate(double s) const {
        const TracedLine& part = on_ahead(s) ? ahead : behind;
        double t = on_ahead(s) ? s : -s;
        // The ends of a closed line meet only within the accuracy of its steps: about its seed it goes on from there.
        const bool about_seed = t > -overlap && t < part.length + overlap;
        if ((closed || opened) && !about_seed) t -= part.length * std::floor(t / part.length);
        const TracedStep& step = part.steps[part.step_at(t)];
        const double x = std::clamp((t - step.s) / step.length, 0.0, 1.0);
        return {&step, x, t - step.s - x * step.length};
    }
};

/// Sample of a line, by their numbers.
struct SampleEntry {
    int line, sample;
};
using SampleGrid = PointCells<SampleEntry>;

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
    static int index(CurvatureFamily family) { return family == CurvatureFamily::maximum ? 0 : 1; }
    static CurvatureFamily other(CurvatureFamily family) {
        return family == CurvatureFamily::maximum ? CurvatureFamily::minimum : CurvatureFamily::maximum;
    }
    TraceOptions trace_options() const {
        return {.length = longest_line * step_,
                .tolerance = relative_tolerance * step_,
                .longest_step = step_,
                .closing_distance = 1e-3 * step_,
                .most_steps = most_line_steps};
    }
    bool crowded(const Sample& sample, CurvatureFamily family, double distance) const;
    bool near(const Sample& sample, const Line& line, int number, double distance) const;
    std::optional<Line> trace(const Seed& seed) const;
    bool add_lines(const std::vector<Seed>& seeds);
    void sample(Line& line) const;
    void grow(std::vector<Line>& lines) const;
    void find_crossings(int number);
    std::optional<std::pair<double, double>> crossing(const Line& a, double sa, const Line& b, double sb) const;
    void add_crossing(int a, double sa, int b, double sb);
    std::vector<Seed> seeds_of(int number) const;
    void refuse(const Seed& seed);
    Vector2 difference(Vector2 d) const;

    const LineTracer& tracer_;
    const LineNetOptions& options_;
    const Progress& progress_;
    double step_;
    std::vector<Line> lines_;
    std::array<SampleGrid, 2> grids_;
    LineNet net_;
};

/// Difference of parameters by the short way around where the surface is closed.
Vector2 NetBuilder::difference(Vector2 d) const {
    const Face& face = tracer_.face();
    const ParameterBox domain = face.surface.domain();
    if (face.u_closed || face.u_periodic) d.x() -= domain.u.length() * std::round(d.x() / domain.u.length());
    if (face.v_closed || face.v_periodic) d.y() -= domain.v.length() * std::round(d.y() / domain.v.length());
    return d;
}

/// Whether a sample of another line, across of it, is nearer than `distance`: lines are compared where they run side by
/// side on one side of the surface.
bool NetBuilder::near(const Sample& sample, const Line& line, int number, double distance) const {
    const Sample& other = line.samples[number];
    if (sample.normal.dot(other.normal) < same_side || std::abs(sample.tangent.dot(other.tangent)) < parallel)
        return false;
    const Vector3 d = sample.point - other.point;
    const double along = d.dot(other.tangent), reach = sample_reach * step_;
    const bool inner = number > 0 && number + 1 < static_cast<int>(line.samples.size());
    if (inner && std::abs(along) > reach) return false;
    return (d - std::clamp(along, -reach, reach) * other.tangent).norm() < distance;
}

bool NetBuilder::crowded(const Sample& sample, CurvatureFamily family, double distance) const {
    bool found = false;
    grids_[index(family)].near(sample.point, distance + sample_reach * step_, [&](const SampleEntry& entry) {
        found = found || near(sample, lines_[entry.line], entry.sample, distance);
    });
    return found;
}

void NetBuilder::sample(Line& line) const {
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

std::optional<Line> NetBuilder::trace(const Seed& seed) const {
    const FieldValue value = tracer_.value(seed.parameters, seed.family);
    if (tracer_.indeterminate(value)) return std::nullopt;
    const auto as_sample = [](const FieldValue& v) -> Sample { return {0.0, {}, v.point, v.tangent, v.normal}; };
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
    Line line;
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
void NetBuilder::grow(std::vector<Line>& lines) const {
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
        const auto is_ahead = [&](const Sample& x) {
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
            const Line& line = lines[event.line];
            const Sample& sample = line.samples[event.sample];
            Ends& own = ends[event.line];
            if (event.ahead ? event.sample > own.high : event.sample < own.low) continue;
            const bool is_seed = event.pace <= tie * step_;
            bool stop = !is_seed && crowded(sample, line.family, distance);
            if (!is_seed)
                grown[index(line.family)].near(
                    sample.point, distance + sample_reach * step_, [&](const SampleEntry& entry) {
                        if (stop) return;
                        const Line& other = lines[entry.line];
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
        Line& line = lines[l];
        const Ends& own = ends[l];
        const std::vector<Sample> all = std::move(line.samples);
        line.samples.clear();
        if (line.closed && !own.high_cut && !own.low_cut) {
            line.samples = all;
            continue;
        }
        // Of a closed line two branches remain; the sample after a whole turn is the seed's.
        for (int i = own.low; i < static_cast<int>(all.size()); ++i) {
            Sample sample = all[i];
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

/// No line shall start there again.
void NetBuilder::refuse(const Seed& seed) {
    if (seed.line < 0) return;
    lines_[seed.line].refused.push_back(seed.s);
    lines_[seed.line].changed = true;
}

/// Adds the lines of seeds that are equally far from the start. False if none of them can start.
bool NetBuilder::add_lines(const std::vector<Seed>& seeds) {
    std::vector<Line> lines;
    std::vector<const Seed*> origins;
    for (const Seed& seed : seeds)
        if (std::optional<Line> line = trace(seed)) {
            lines.push_back(std::move(*line));
            origins.push_back(&seed);
        } else {
            refuse(seed);
        }
    grow(lines);
    bool added = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!(lines[i].high - lines[i].low > sample_share * step_)) {
            refuse(*origins[i]);
            continue;
        }
        const int number = static_cast<int>(lines_.size());
        lines_.push_back(std::move(lines[i]));
        find_crossings(number);
        const Line& line = lines_.back();
        for (std::size_t k = 0; k < line.samples.size(); ++k)
            grids_[index(line.family)].add(line.samples[k].point, {number, static_cast<int>(k)});
        added = true;
        // A line that does not cross the one it should is of no use there again.
        refuse(*origins[i]);
        // A half-line from an umbilic begins a little beside it.
        if (origins[i]->one_way)
            lines_.back().crossings.emplace(-(line.samples.front().point - net_.nodes.front().point).norm(), 0);
    }
    return added;
}

/// Newton's method (thesis (3.48)) on the parameters of both lines.
std::optional<std::pair<double, double>> NetBuilder::crossing(const Line& a, double sa, const Line& b,
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
        const auto within = [&](const Line& line, double s) {
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
    const auto known = [&](const Line& line, double s) {
        const auto above = line.crossings.lower_bound(s - same_crossing * step_);
        return above != line.crossings.end() && above->first < s + same_crossing * step_;
    };
    if (known(lines_[a], sa) && known(lines_[b], sb)) return;
    const Vector2 p = tracer_.wrapped(lines_[a].at(sa));
    const int node = static_cast<int>(net_.nodes.size());
    const auto distance = [](const Line& line, double s) {
        return line.distance + (line.closed ? std::min(std::abs(s), std::abs(line.high - s)) : std::abs(s));
    };
    net_.nodes.push_back(
        {p, tracer_.face().surface.value(p.x(), p.y()), std::min(distance(lines_[a], sa), distance(lines_[b], sb))});
    lines_[a].crossings.emplace(sa, node);
    lines_[b].crossings.emplace(sb, node);
    lines_[a].changed = lines_[b].changed = true;
}

void NetBuilder::find_crossings(int number) {
    const Line& line = lines_[number];
    const SampleGrid& grid = grids_[1 - index(line.family)];
    // First guesses by segments between samples; then exactly.
    std::vector<std::tuple<double, int, double>> guesses;
    for (std::size_t i = 0; i + 1 < line.samples.size(); ++i) {
        const Sample &p = line.samples[i], &q = line.samples[i + 1];
        const Vector3 d = q.point - p.point;
        grid.near(0.5 * (p.point + q.point), segment_reach * step_, [&](const SampleEntry& entry) {
            const Line& across = lines_[entry.line];
            if (entry.sample + 1 >= static_cast<int>(across.samples.size())) return;
            const Sample &r = across.samples[entry.sample], &t = across.samples[entry.sample + 1];
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

/// Places on a line where crossing lines are missing.
std::vector<Seed> NetBuilder::seeds_of(int number) const {
    const Line& line = lines_[number];
    std::vector<Seed> seeds;
    const auto add = [&](double s) {
        if (line.closed) s -= line.high * std::floor(s / line.high);
        if (s < line.low || s > line.high) return;
        for (const double refused : line.refused)
            if (std::abs(refused - s) < same_crossing * step_) return;
        const double way = line.closed ? std::min(s, line.high - s) : std::abs(s);
        seeds.push_back(
            {line.distance + way, tracer_.wrapped(line.at(s)), other(line.family), std::nullopt, number, s});
    };
    if (line.crossings.empty()) return seeds;
    const double first = line.crossings.begin()->first, last = line.crossings.rbegin()->first;
    const auto fill = [&](double low, double high) {
        const double gap = high - low;
        if (gap <= longest_gap * step_) return;
        const double part = gap / std::max(2.0, std::round(gap / step_ - 0.137));
        // From the end that is nearer to the seed of the line; from both if they are equally near.
        const double from_low = line.closed ? std::min(low, line.high - low) : std::abs(low);
        const double from_high = line.closed ? std::abs(line.high - high) : std::abs(high);
        if (from_low <= from_high + tie * step_) add(low + part);
        if (from_high <= from_low + tie * step_) add(high - part);
    };
    if (line.closed) {
        fill(last, first + line.high);
    } else {
        if (line.high - last > longest_end * step_) add(last + step_);
        if (first - line.low > longest_end * step_) add(first - step_);
    }
    for (auto at = line.crossings.begin(); std::next(at) != line.crossings.end(); ++at)
        fill(at->first, std::next(at)->first);
    return seeds;
}

LineNet NetBuilder::build(const NetStart& start) {
    std::vector<Seed> seeds;
    if (start.spokes.empty()) {
        for (const CurvatureFamily family : {CurvatureFamily::maximum, CurvatureFamily::minimum})
            seeds.push_back({0.0, start.parameters, family, std::nullopt, -1, 0.0});
    } else {
        net_.nodes.push_back(
            {start.parameters, tracer_.face().surface.value(start.parameters.x(), start.parameters.y()), 0.0});
        for (const NetStart::Spoke& spoke : start.spokes)
            seeds.push_back({0.0, spoke.parameters, spoke.family, spoke.direction, -1, 0.0});
    }
    add_lines(seeds);
    while (lines_.size() < options_.most_lines) {
        progress_.check();
        seeds.clear();
        // Those that are nearest to the start, all at once.
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (lines_[i].changed) lines_[i].seeds = seeds_of(static_cast<int>(i));
            lines_[i].changed = false;
            for (const Seed& seed : lines_[i].seeds) nearest = std::min(nearest, seed.distance);
        }
        for (const Line& line : lines_)
            std::copy_if(line.seeds.begin(), line.seeds.end(), std::back_inserter(seeds),
                         [&](const Seed& seed) { return seed.distance <= nearest + tie * step_; });
        if (seeds.empty()) break;
        add_lines(seeds);
    }
    net_.lines = static_cast<int>(lines_.size());
    for (const Line& line : lines_) {
        const auto join = [&](double s, int from, double t, int to) {
            NetEdge edge{from, to, line.family, t - s};
            for (int k = 1; k <= between_points; ++k) {
                double at = s + (t - s) * k / (between_points + 1);
                if (line.closed && at > line.high) at -= line.high;
                const Vector2 p = tracer_.wrapped(line.at(at));
                edge.between.push_back(tracer_.face().surface.value(p.x(), p.y()));
            }
            net_.edges.push_back(std::move(edge));
        };
        for (auto at = line.crossings.begin(); at != line.crossings.end() && std::next(at) != line.crossings.end();
             ++at)
            join(at->first, at->second, std::next(at)->first, std::next(at)->second);
        if (line.closed && line.crossings.size() > 2)
            join(line.crossings.rbegin()->first, line.crossings.rbegin()->second,
                 line.crossings.begin()->first + line.high, line.crossings.begin()->second);
    }
    return std::move(net_);
}

}  // namespace

LineNet line_net(const LineTracer& tracer, const NetStart& start, const LineNetOptions& options,
                 const Progress& progress) {
    return NetBuilder(tracer, options, progress).build(start);
}

}  // namespace umbilic
