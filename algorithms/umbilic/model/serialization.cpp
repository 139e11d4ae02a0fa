// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/model/serialization.h>

#include <algorithm>
#include <concepts>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

#include <boost/crc.hpp>

#include <umbilic/core/errors.h>
#include <umbilic/model/binary_stream.h>

namespace umbilic {

namespace {

constexpr std::string_view model_magic = "UMBMODEL";
constexpr std::string_view meshes_magic = "UMBMESHS";
constexpr std::uint32_t version = 1;

/// Bytes are read in pieces of this size, so that a wrong length field allocates no more than has arrived.
constexpr std::size_t piece = std::size_t(1) << 20;

constexpr int any_int = std::numeric_limits<std::int32_t>::max();

std::uint32_t checksum(std::string_view header, std::string_view contents) {
    boost::crc_32_type crc;
    crc.process_bytes(header.data(), header.size());
    crc.process_bytes(contents.data(), contents.size());
    return crc.checksum();
}

std::string header_of(std::string_view magic, std::uint64_t length) {
    BinaryWriter writer;
    writer.add(version);
    writer.add(length);
    return std::string(magic) + writer.bytes();
}

void write_envelope(std::string_view magic, const std::string& contents, std::ostream& out) {
    const std::string header = header_of(magic, contents.size());
    BinaryWriter end;
    end.add(checksum(header, contents));
    out << header << contents << end.bytes();
}

std::string read_exactly(std::istream& in, std::uint64_t size) {
    std::string result;
    while (result.size() < size) {
        const std::size_t before = result.size();
        const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(piece, size - before));
        result.resize(before + step);
        if (!in.read(result.data() + before, static_cast<std::streamsize>(step)))
            throw InvalidInput("binary data: the bytes end too early");
    }
    return result;
}

std::string read_envelope(std::string_view magic, std::istream& in) {
    const std::string header = read_exactly(in, magic.size() + 12);
    if (!header.starts_with(magic)) throw InvalidInput("binary data: not Umbilic's own form");
    BinaryReader fields(std::string_view(header).substr(magic.size()));
    const auto found = fields.integer<std::uint32_t>();
    if (found != version)
        throw InvalidInput("binary data: version " + std::to_string(found) + ", this program reads version " +
                           std::to_string(version) + "; write it again with the same Umbilic");
    std::string contents = read_exactly(in, fields.integer<std::uint64_t>());
    const std::string end = read_exactly(in, 4);
    if (BinaryReader(end).integer<std::uint32_t>() != checksum(header, contents))
        throw InvalidInput("binary data: the checksum does not fit");
    return contents;
}

// Records in which nothing has to be checked but that numbers are finite: their members in the order of the bytes.

template <class Record, class Type>
concept of_type = std::same_as<std::remove_const_t<Record>, Type>;

auto members(of_type<ElementarySurface> auto& surface) {
    return std::tie(surface.location, surface.axis, surface.x_axis, surface.radius, surface.minor_radius,
                    surface.semi_angle);
}
auto members(of_type<Solid> auto& solid) {
    return std::tie(solid.volume, solid.area, solid.centroid, solid.inertia, solid.name);
}
auto members(of_type<Source> auto& source) {
    return std::tie(source.path, source.sha256, source.bytes, source.format, source.unit, source.unit_in_mm);
}

template <class Record>
void add_members(BinaryWriter& out, const Record& record) {
    std::apply([&](const auto&... member) { (out.add(member), ...); }, members(record));
}
template <class Record>
Record record(BinaryReader& in) {
    Record result;
    std::apply([&](auto&... member) { (in.read(member), ...); }, members(result));
    return result;
}

// Other parts of a model, each written and read by a pair of functions that stand together.

void add(BinaryWriter& out, const KnotVector& knots) {
    out.add(std::int32_t(knots.degree()));
    out.add_all(knots.knots(), [&](double knot) { out.add(knot); });
}
KnotVector knot_vector(BinaryReader& in) {
    const int degree = in.integer_in(1, maximum_degree);
    return KnotVector(degree, in.all(8, [&] { return in.number(); }));
}

void add(BinaryWriter& out, const NurbsSurface& surface) {
    add(out, surface.u_knots());
    add(out, surface.v_knots());
    out.add_all(surface.poles(), [&](const Vector3& pole) { out.add(pole); });
    out.add_all(surface.weights(), [&](double weight) { out.add(weight); });
}
NurbsSurface nurbs_surface(BinaryReader& in) {
    KnotVector u = knot_vector(in), v = knot_vector(in);
    auto poles = in.all(24, [&] { return in.matrix<Vector3>(); });
    auto weights = in.all(8, [&] { return in.number(); });
    return NurbsSurface(std::move(u), std::move(v), std::move(poles), std::move(weights));
}

void add(BinaryWriter& out, const ParameterMap& map) {
    out.add_all(map.breaks(), [&](double value) { out.add(value); });
}
ParameterMap parameter_map(BinaryReader& in) {
    auto breaks = in.all(8, [&] { return in.number(); });
    return breaks.empty() ? ParameterMap() : ParameterMap::angular(std::move(breaks));
}

void add(BinaryWriter& out, const TrimmingCurve& curve) {
    add(out, curve.curve.knots());
    out.add_all(curve.curve.poles(), [&](const Vector2& pole) { out.add(pole); });
    out.add_all(curve.curve.weights(), [&](double weight) { out.add(weight); });
    out.add_flag(curve.reversed);
    out.add(std::int32_t(curve.edge));
    out.add_flag(curve.degenerate);
    out.add(curve.tolerance);
}
TrimmingCurve trimming_curve(BinaryReader& in) {
    KnotVector knots = knot_vector(in);
    auto poles = in.all(16, [&] { return in.matrix<Vector2>(); });
    auto weights = in.all(8, [&] { return in.number(); });
    TrimmingCurve result{NurbsCurve2(std::move(knots), std::move(poles), std::move(weights))};
    result.reversed = in.flag();
    result.edge = in.integer_in(0, any_int);
    result.degenerate = in.flag();
    result.tolerance = in.number();
    return result;
}

void add(BinaryWriter& out, const TrimmingRegion& region) {
    add(out, region.u_map());
    add(out, region.v_map());
    out.add_all(region.loops(), [&](const TrimmingLoop& loop) {
        out.add_all(loop, [&](const TrimmingCurve& curve) { add(out, curve); });
    });
}
TrimmingRegion trimming_region(BinaryReader& in, const ParameterBox& domain) {
    ParameterMap u = parameter_map(in), v = parameter_map(in);
    auto loops = in.all(8, [&] { return in.all(8, [&] { return trimming_curve(in); }); });
    return TrimmingRegion(domain, std::move(loops), std::move(u), std::move(v));
}

void add(BinaryWriter& out, const Face& face) {
    out.add(std::int32_t(face.number));
    out.add(std::int32_t(face.kind));
    out.add_flag(face.elementary.has_value());
    if (face.elementary) add_members(out, *face.elementary);
    add(out, face.surface);
    add(out, face.region);
    for (const bool flag : {face.reversed, face.u_closed, face.v_closed, face.u_periodic, face.v_periodic})
        out.add_flag(flag);
    for (const double value : {face.area, face.conversion_error, face.tolerance}) out.add(value);
    out.add(face.name);
    out.add_flag(face.color.has_value());
    if (face.color)
        for (const double channel : *face.color) out.add(channel);
    out.add(std::int32_t(face.solid));
}
Face face(BinaryReader& in, int solid_count) {
    const int number = in.integer_in(1, any_int);
    const auto kind = static_cast<SurfaceKind>(in.integer_in(0, static_cast<int>(SurfaceKind::other)));
    std::optional<ElementarySurface> elementary;
    if (in.flag()) elementary = record<ElementarySurface>(in);
    NurbsSurface surface = nurbs_surface(in);
    TrimmingRegion region = trimming_region(in, surface.domain());
    Face result{number, kind, elementary, std::move(surface), std::move(region)};
    for (bool* flag : {&result.reversed, &result.u_closed, &result.v_closed, &result.u_periodic, &result.v_periodic})
        *flag = in.flag();
    for (double* value : {&result.area, &result.conversion_error, &result.tolerance}) *value = in.number();
    result.name = in.text();
    if (in.flag()) {
        std::array<double, 3> color{};
        for (double& channel : color) channel = in.number();
        result.color = color;
    }
    result.solid = in.integer_in(-1, solid_count - 1);
    return result;
}

void add(BinaryWriter& out, const BoundingBox& box) {
    out.add_flag(box.empty());
    if (box.empty()) return;
    out.add(box.low);
    out.add(box.high);
}
BoundingBox bounding_box(BinaryReader& in) {
    BoundingBox result;
    if (in.flag()) return result;
    result.low = in.matrix<Vector3>();
    result.high = in.matrix<Vector3>();
    if (result.empty()) throw InvalidInput("binary data: a box has its corners exchanged");
    return result;
}

void check_numbers(const Model& model) {
    for (std::size_t i = 1; i < model.faces.size(); ++i)
        if (model.faces[i].number <= model.faces[i - 1].number)
            throw InvalidInput("binary data: the faces are not in the order of their numbers");
}

}  // namespace

void write_model(const Model& model, std::ostream& out) {
    BinaryWriter writer;
    add_members(writer, model.source);
    writer.add_all(model.solids, [&](const Solid& solid) { add_members(writer, solid); });
    writer.add_all(model.faces, [&](const Face& face) { add(writer, face); });
    writer.add(std::int32_t(model.shells));
    writer.add(std::int32_t(model.declared_faces));
    writer.add_flag(model.valid);
    writer.add_all(model.skipped, [&](const Skipped& skipped) {
        writer.add(std::int32_t(skipped.face));
        writer.add(skipped.entity);
        writer.add(skipped.why);
    });
    for (const auto* texts : {&model.repaired, &model.warnings})
        writer.add_all(*texts, [&](const std::string& text) { writer.add(text); });
    add(writer, model.box);
    writer.add(model.area);
    writer.add(model.volume);
    write_envelope(model_magic, writer.bytes(), out);
}

Model read_model(std::istream& in) {
    const std::string contents = read_envelope(model_magic, in);
    BinaryReader reader(contents);
    Model model;
    model.source = record<Source>(reader);
    model.solids = reader.all(8, [&] { return record<Solid>(reader); });
    const int solid_count = static_cast<int>(model.solids.size());
    model.faces = reader.all(8, [&] { return face(reader, solid_count); });
    model.shells = reader.integer_in(0, any_int);
    model.declared_faces = reader.integer_in(-1, any_int);
    model.valid = reader.flag();
    model.skipped = reader.all(8, [&] {
        Skipped skipped;
        skipped.face = reader.integer_in(0, any_int);
        skipped.entity = reader.text();
        skipped.why = reader.text();
        return skipped;
    });
    for (auto* texts : {&model.repaired, &model.warnings}) *texts = reader.all(8, [&] { return reader.text(); });
    model.box = bounding_box(reader);
    model.area = reader.number();
    model.volume = reader.number();
    if (!reader.at_end()) throw InvalidInput("binary data: bytes are left over");
    check_numbers(model);
    return model;
}

void write_display_meshes(const std::vector<DisplayMesh>& meshes, std::ostream& out) {
    BinaryWriter writer;
    writer.add_all(meshes, [&](const DisplayMesh& mesh) {
        writer.add(std::int32_t(mesh.face));
        writer.add_all(mesh.points, [&](const Vector3& point) { writer.add(point); });
        writer.add_all(mesh.parameters, [&](const Vector2& parameters) { writer.add(parameters); });
        writer.add_all(mesh.triangles, [&](const std::array<int, 3>& triangle) {
            for (const int index : triangle) writer.add(std::int32_t(index));
        });
    });
    write_envelope(meshes_magic, writer.bytes(), out);
}

std::vector<DisplayMesh> read_display_meshes(std::istream& in) {
    const std::string contents = read_envelope(meshes_magic, in);
    BinaryReader reader(contents);
    auto meshes = reader.all(8, [&] {
        DisplayMesh mesh;
        mesh.face = reader.integer_in(1, any_int);
        mesh.points = reader.all(24, [&] { return reader.matrix<Vector3>(); });
        mesh.parameters = reader.all(16, [&] { return reader.matrix<Vector2>(); });
        if (mesh.parameters.size() != mesh.points.size())
            throw InvalidInput("binary data: a mesh has other numbers of points and parameters");
        const int last = static_cast<int>(mesh.points.size()) - 1;
        mesh.triangles = reader.all(12, [&] {
            std::array<int, 3> triangle{};
            for (int& index : triangle) index = reader.integer_in(0, last);
            return triangle;
        });
        return mesh;
    });
    if (!reader.at_end()) throw InvalidInput("binary data: bytes are left over");
    return meshes;
}

}  // namespace umbilic
