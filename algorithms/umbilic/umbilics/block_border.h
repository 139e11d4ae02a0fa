// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <umbilic/umbilics/winding.h>

namespace umbilic {

/// An umbilic as a block sees it.
struct Place {
    Vector2 at = Vector2::Zero();
    Vector2 patch_size = Vector2::Ones();
    double index = 0.0;
};

/// The place is on the border of its block, or so near that a border along the edges may not be evaluated.
bool on_border(const Place& place, const ParameterBox& block);

/// Closed boxes with a point in common.
bool meet(const ParameterBox& a, const ParameterBox& b);

/// The border of a smooth block where it is not to run along the edges as they are: it goes around the umbilics on it,
/// around what the search left open, and around places where (A, B) is lost in rounding (docs/numerics.md,
/// "Certificate").
class BlockBorder {
public:
    /// `places` must stay alive. `open`: boxes that are left out.
    BlockBorder(const NurbsSurface& surface, const BezierPatches& patches, const InputRounding& input,
                const PatchRange& range, const ParameterBox& domain, const std::vector<Place>& places,
                std::vector<ParameterBox> open);

    /// Half the winding along the border, less the indices of the places inside: 0 if none is missing. None if it
    /// cannot be evaluated; obstacle() is where.
    std::optional<double> excess();
    const Vector2& obstacle() const { return obstacle_; }
    bool went_around() const { return kept_.size() > 1; }
    int places_left_out() const { return static_cast<int>(cuts_.size()); }

private:
    struct Cut {
        ParameterBox core;
        Vector2 patch_size;
        double size = 0.0;       ///< half side around `core`, relative to the patch
        std::size_t number = 0;  ///< in removed_
    };

    double excess_of(double winding) const;
    bool left_out(const Vector2& at) const;
    /// Adds a box around `place` that holds no other umbilic, or leaves the place out if no size serves.
    void go_around(const Place& place);
    /// Leaves out what is around the obstacles, more of it where that was tried before. False if that grows too large.
    bool leave_out(const std::vector<BorderSide>& obstacles);

    const NurbsSurface& surface_;
    PathTurning turning_;
    ParameterBox domain_;
    const std::vector<Place>& places_;
    std::vector<ParameterBox> kept_, removed_;
    std::vector<Cut> cuts_;
    Vector2 obstacle_ = Vector2::Zero();
};

}  // namespace umbilic
