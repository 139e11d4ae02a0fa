// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <umbilic/core/types.h>
#include <umbilic/nurbs/nurbs_surface.h>
#include <umbilic/nurbs/trimming.h>

namespace umbilic {

/// What kind of surface a face had in its file.
enum class SurfaceKind { plane, cylinder, cone, sphere, torus, bezier, bspline, revolution, extrusion, offset, other };

/// True for planes, cylinders, cones, spheres and tori.
bool elementary(SurfaceKind kind);

/// Parameters of an elementary surface, in model coordinates (mm, radians).
struct ElementarySurface {
    /// Point on a plane; centre of a sphere or torus; point on the axis of a cylinder; for a cone the point of the axis
    /// at which its radius is `radius`.
    Vector3 location = Vector3::Zero();
    /// Unit normal of a plane, unit axis otherwise.
    Vector3 axis = Vector3::UnitZ();
    /// Unit direction of the angle 0, normal to the axis.
    Vector3 x_axis = Vector3::UnitX();
    /// Radius of a cylinder, sphere, cone (at `location`), major radius of a torus; 0 for a plane.
    double radius = 0.0;
    double minor_radius = 0.0;
    /// Half angle of a cone, in (-pi/2, pi/2), positive if the radius grows along the axis.
    double semi_angle = 0.0;
};

/// One face of a model: the exact NURBS form of its surface, cut by trimming loops.
struct Face {
    /// From 1, in the order of TopExp's map of the read shape; faces that were skipped keep their number for
    /// themselves.
    int number = 0;
    SurfaceKind kind = SurfaceKind::bspline;
    std::optional<ElementarySurface> elementary;
    NurbsSurface surface;
    TrimmingRegion region;
    /// True if the face's outward side is against r_u x r_v of its surface.
    bool reversed = false;
    bool u_closed = false, v_closed = false;
    bool u_periodic = false, v_periodic = false;
    /// Area in mm^2: of the whole surface by quadrature, of a trimmed one from the kernel's integration.
    double area = 0.0;
    /// Largest distance (mm) between the file's surface and `surface`; 0 if the conversion is exact.
    double conversion_error = 0.0;
    /// Largest tolerance (mm) the file states for the face, its edges and vertices.
    double tolerance = 0.0;
    std::string name;
    std::optional<std::array<double, 3>> color;
    /// Index into Model::solids, or -1.
    int solid = -1;
};

/// Volume integrals of a solid with density 1 (thesis 4.5), from the kernel.
struct Solid {
    double volume = 0.0;                 ///< mm^3
    double area = 0.0;                   ///< mm^2
    Vector3 centroid = Vector3::Zero();  ///< mm
    Matrix3 inertia = Matrix3::Zero();   ///< mm^5, about the centroid, axes of the model
    std::string name;
};

/// A face or entity of the file that did not become part of the model, and why.
struct Skipped {
    int face = 0;        ///< number of the face, or 0 if it never became one
    std::string entity;  ///< name of the file's entity, if no face
    std::string why;
};

/// The file a model came from, as an exhibit.
struct Source {
    std::string path;
    std::string sha256;  ///< lower-case hexadecimal
    std::uint64_t bytes = 0;
    std::string format;  ///< "STEP", "IGES", "BREP", "points", or "shape" for one handed over in memory
    std::string unit;    ///< the unit the file declares, e.g. "mm", "inch"
    double unit_in_mm = 1.0;
};

/// A CAD model as everything behind the adapter sees it. Lengths in mm.
struct Model {
    Source source;
    std::vector<Face> faces;
    std::vector<Solid> solids;
    int shells = 0;
    /// Number of faces the file declares, as far as it can be told without the kernel; -1 if unknown.
    int declared_faces = -1;
    /// False if the kernel finds the topology invalid.
    bool valid = true;
    std::vector<Skipped> skipped;
    std::vector<std::string> repaired;
    std::vector<std::string> warnings;
    /// Box of the trimmed faces.
    BoundingBox box;
    /// Sum of the faces' areas (mm^2) and of the solids' volumes (mm^3).
    double area = 0.0;
    double volume = 0.0;

    /// Length that tolerances are relative to: sqrt(area), in mm.
    double size() const;
    /// The face with this number. Throws InvalidInput, naming the file, if there is none.
    const Face& face(int number) const;
    /// True if all faces belong to solids, so that every normal has a true outward side.
    bool oriented() const;
};

/// Lower-case name as in the JSON results ("plane", "bspline", ...).
const char* name(SurfaceKind kind);

}  // namespace umbilic
