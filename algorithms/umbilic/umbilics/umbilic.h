// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/differential/monge_form.h>
#include <umbilic/differential/recognise.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

enum class UmbilicType { star, monstar, lemon, non_generic };
/// Whether the cubic form of a star has three real root lines (elliptic) or one (hyperbolic).
enum class StarKind { none, elliptic, hyperbolic };

/// The four types that survive a small change of the surface.
enum class GenericType { elliptic_star, hyperbolic_star, monstar, lemon };

/// Bounds on the errors of the invariants of a cubic form that is known up to an error.
struct ClassUncertainty {
    double delta = 0.0;
    double zeta = 0.0;
    std::optional<double> omega;  ///< none where omega has no value or no bound
};

/// What the cubic form at an umbilic says (thesis 2.1.4 and Appendix A, with the corrections named in
/// docs/numerics.md).
struct UmbilicClass {
    std::complex<double> alpha, beta;  ///< complex form of the cubic (2.28)-(2.29), 1/mm^2
    std::optional<std::complex<double>>
        omega;                  ///< (2.30), representative with argument in [-pi/3, pi/3); none where alpha vanishes
    double delta = 0.0;         ///< (|alpha|^2 - |beta|^2) / (|alpha|^2 + |beta|^2), in [-1, 1]
    std::complex<double> zeta;  ///< alpha beta^3 / (|alpha|^2 + |beta|^2)^2, turns with no frame
    UmbilicType type = UmbilicType::non_generic;
    StarKind star = StarKind::none;
    /// Where `type` is non_generic: the types that forms within the error have, two at least.
    std::vector<GenericType> neighbours;
    std::optional<int> ridges;  ///< ridge lines through the umbilic, 3 inside Gamma_1 and 1 outside; none on it
    std::vector<double>
        angles;           ///< 1 or 3 directions of lines of curvature, radians from the frame's x axis, in [0, pi)
    double margin = 0.0;  ///< relative error of the cubic form up to which no dividing curve is met, at most 1
    ClassUncertainty uncertainty;

    /// The one type of a generic umbilic, the neighbours of a non-generic one.
    std::vector<GenericType> possible_types() const;
};

/// Classifies a cubic form by discriminants: Gamma_1 (number of root lines and of ridges), |omega| = 1 (index) and
/// Gamma_2 (number of lines of curvature). `relative_error` bounds the error of the form relative to its own size, both
/// in the norm of Cubic::squared_norm(). If forms within it lie on different sides of a dividing curve the type is
/// non_generic.
UmbilicClass classify(const Cubic& cubic, double relative_error);

/// Least distance of two values of omega, of which each has three.
double omega_distance(std::complex<double> a, std::complex<double> b);

UmbilicType type_of(GenericType type);
StarKind star_of(GenericType type);
/// None for non_generic.
std::optional<GenericType> generic_type(UmbilicType type, StarKind star);

/// The form with alpha = 1 and beta = omega in the frame of its own (thesis A.3): z = -(kappa / 2)(x^2 + y^2) +
/// C(x, y) / 6 is a surface with this omega at the origin.
Cubic cubic_of_omega(std::complex<double> omega);

/// Whether a point is a pole: a side of the surface's domain that is a single point in space.
enum class PoleKind {
    none,
    inner,  ///< the surface closes around it
    border  ///< a corner of the surface
};

/// An isolated umbilical point of a face.
struct Umbilic {
    SurfacePoint at;
    Vector3 point = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< r_u x r_v / |...| of the surface, whatever the face's orientation
    Vector3 x_axis = Vector3::UnitX();  ///< r_u / |r_u|: frame of `cubic`, with y = normal x x_axis
    double kappa = 0.0;                 ///< normal curvature, 1/mm, sign as in the thesis
    double kappa_error = 0.0;           ///< bound on its error, 1/mm
    Cubic cubic;
    double cubic_error = 0.0;  ///< bound on the norm of its error, 1/mm^2; may be infinite
    UmbilicClass kind;
    bool flat = false;  ///< kappa is 0 within its error bound
    /// Displacement of the surface's control points, mm, up to which the type stays what it is; 0 if it is non-generic.
    double margin = 0.0;
    /// The umbilic lies on, or within reach of, a knot line across which third derivatives jump: `kind` then covers the
    /// cubic forms of all sides.
    bool on_knot_line = false;
    double index = 0.0;               ///< -0.5 for a star, +0.5 for lemon and monstar; see also `pole`
    std::vector<Vector3> directions;  ///< unit tangents of the lines of curvature that run into it
    ParameterBox box;                 ///< box inside which existence and uniqueness were proved
    double radius = 0.0;  ///< proved distance from (u, v) to the true umbilic, relative to the domain's sides
    bool certified = false;
    Containment containment = Containment::inside;
    /// At a pole `box` is the whole side of the domain; the index is the turning of the principal directions around it
    /// in the tangent plane (of a corner: as if its sector were repeated), a multiple of 1/2.
    PoleKind pole = PoleKind::none;
};

/// Boxes that the search could neither accept nor exclude, joined where they touch.
struct UndecidedCluster {
    std::vector<ParameterBox> boxes;
    std::optional<double> index;  ///< index of whatever lies inside, from the winding around it
};

/// Why a line of umbilics ends where it does: it closes, meets the border of the surface, a knot line behind which it
/// has no continuation, or a point at which the equations lose the rank that makes it a smooth line.
enum class LineEnd { closed, border, knot, singular };

/// A curve of umbilics.
struct UmbilicLine {
    std::vector<ParameterBox> boxes;  ///< what the search left open; the line lies in them
    std::vector<Vector2> parameters;  ///< (u, v) of points in order along the line
    std::vector<Vector3> points;      ///< the same in space; the last one is the first one if the line is closed
    bool closed = false;
    std::array<LineEnd, 2> ends = {LineEnd::singular, LineEnd::singular};  ///< at the first and last point
    double length = 0.0;                                                   ///< mm
    /// Estimate of the distance of `parameters` from the true line, relative to the domain's sides: the last Newton
    /// step and what is left of the equations.
    double accuracy = 0.0;
    Containment containment = Containment::inside;  ///< boundary: it lies in the face's loops in part
};

enum class UmbilicRegionKind { planar, spherical, other };

/// A closed polyline around a region, or around a hole in it; the last point equals the first.
struct RegionBoundary {
    std::vector<Vector2> parameters;  ///< (u, v)
    std::vector<Vector3> points;
};

/// A part of a face on which every point is an umbilic. On a polynomial piece of a surface either all points are, or
/// none but points and lines: regions are made of whole pieces, cut by the face's loops.
struct UmbilicRegion {
    UmbilicRegionKind kind = UmbilicRegionKind::other;
    std::vector<ParameterBox> boxes;   ///< the pieces
    std::vector<ParameterBox> border;  ///< boxes beside them that the search left open
    double area = 0.0;                 ///< mm^2, of the pieces inside the face's loops
    /// The plane or sphere; meaningless for other kinds.
    ElementarySurface surface;
    double deviation = 0.0;                ///< mm, largest distance of the region from `surface`
    std::vector<RegionBoundary> boundary;  ///< of the part inside the face's loops; empty: all of a face of known kind
};

/// Completeness: on a domain, the indices of all umbilics sum to the winding of the principal direction field along its
/// boundary. An umbilic on the boundary counts as inside, poles at corners do not count.
struct Certificate {
    double index_sum = 0.0;
    double boundary_winding = 0.0;  ///< turns, a multiple of 1/2; meaningful only where `complete` has a value
    std::optional<bool> complete;   ///< no value: could not be evaluated
    std::string why;                ///< on what the verdict rests, or why there is none
};

struct UmbilicSearchStatistics {
    int patches = 0;  ///< Bezier patches searched
    int formed = 0;   ///< patches whose equations had to be formed
    long boxes = 0;   ///< boxes visited
    bool budget_exhausted = false;
};

/// Everything umbilic on one face (its whole domain, with `containment` telling what lies inside its loops).
struct FaceUmbilics {
    int face = 0;
    /// What the face's NURBS surface was recognised as, where the answer rests on that.
    std::optional<RecognisedSurface> recognised;
    std::vector<Umbilic> umbilics;  ///< ordered by u, then v
    std::vector<UndecidedCluster> undecided;
    std::vector<UmbilicLine> lines;
    std::vector<UmbilicRegion> regions;
    Certificate certificate;
    /// What was searched and certified: whole Bezier patches, at least those that the face's loops touch.
    ParameterBox searched;
    UmbilicSearchStatistics statistics;
};

/// Lower-case words of the JSON results.
const char* name(UmbilicType type);
const char* name(StarKind kind);
const char* name(GenericType type);
const char* name(UmbilicRegionKind kind);
const char* name(LineEnd end);

}  // namespace umbilic
