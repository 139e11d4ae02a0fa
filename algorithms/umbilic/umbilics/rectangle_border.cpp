// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/umbilics/rectangle_border.h>

#include <algorithm>

namespace umbilic {

namespace {

using Intervals = std::vector<ParameterInterval>;

/// Disjoint and increasing; intervals that touch are joined.
Intervals united(Intervals intervals) {
    std::sort(intervals.begin(), intervals.end(),
              [](const ParameterInterval& a, const ParameterInterval& b) { return a.low < b.low; });
    Intervals result;
    for (const ParameterInterval& interval : intervals) {
        if (!(interval.low < interval.high)) continue;
        if (result.empty() || interval.low > result.back().high)
            result.push_back(interval);
        else
            result.back().high = std::max(result.back().high, interval.high);
    }
    return result;
}

/// Both disjoint and increasing.
Intervals difference(const Intervals& whole, const Intervals& taken) {
    Intervals result;
    std::size_t next = 0;
    for (const ParameterInterval& interval : whole) {
        double low = interval.low;
        while (next < taken.size() && taken[next].high <= low) ++next;
        for (std::size_t k = next; k < taken.size() && taken[k].low < interval.high; ++k) {
            if (taken[k].low > low) result.push_back({low, taken[k].low});
            low = std::max(low, taken[k].high);
        }
        if (low < interval.high) result.push_back({low, interval.high});
    }
    return result;
}

/// Rectangles in the order in which a line that moves to larger u enters them.
class Sweep {
public:
    explicit Sweep(std::span<const ParameterBox> boxes) : boxes_(boxes.begin(), boxes.end()) {
        std::sort(boxes_.begin(), boxes_.end(),
                  [](const ParameterBox& a, const ParameterBox& b) { return a.u.low < b.u.low; });
    }

    /// What they cover right of u, before the next end of one of them; u increasing from call to call.
    Intervals covered(double u) {
        std::erase_if(entered_, [u](const ParameterBox& box) { return box.u.high <= u; });
        for (; next_ < boxes_.size() && boxes_[next_].u.low <= u; ++next_)
            if (boxes_[next_].u.high > u) entered_.push_back(boxes_[next_]);
        Intervals result;
        for (const ParameterBox& box : entered_) result.push_back(box.v);
        return united(std::move(result));
    }

private:
    std::vector<ParameterBox> boxes_, entered_;
    std::size_t next_ = 0;
};

/// The sides at constant u.
std::vector<BorderSide> sides_across_u(std::span<const ParameterBox> kept, std::span<const ParameterBox> removed) {
    std::vector<double> ends;
    for (const std::span<const ParameterBox> boxes : {kept, removed})
        for (const ParameterBox& box : boxes) ends.insert(ends.end(), {box.u.low, box.u.high});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

    std::vector<BorderSide> result;
    Sweep kept_sweep(kept), removed_sweep(removed);
    Intervals before;
    for (const double u : ends) {
        Intervals after = difference(kept_sweep.covered(u), removed_sweep.covered(u));
        for (const ParameterInterval& side : difference(before, after))
            result.push_back({{u, side.low}, {u, side.high}});
        for (const ParameterInterval& side : difference(after, before))
            result.push_back({{u, side.high}, {u, side.low}});
        before = std::move(after);
    }
    return result;
}

std::vector<ParameterBox> exchanged(std::span<const ParameterBox> boxes) {
    std::vector<ParameterBox> result;
    for (const ParameterBox& box : boxes) result.push_back({box.v, box.u});
    return result;
}

}  // namespace

std::vector<BorderSide> border_of_difference(std::span<const ParameterBox> kept,
                                             std::span<const ParameterBox> removed) {
    std::vector<BorderSide> result = sides_across_u(kept, removed);
    // With u and v exchanged what is kept lies on the right.
    for (const BorderSide& side : sides_across_u(exchanged(kept), exchanged(removed)))
        result.push_back({{side.to.y(), side.to.x()}, {side.from.y(), side.from.x()}});
    return result;
}

}  // namespace umbilic
