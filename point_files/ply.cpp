// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <point_files/binary_numbers.h>
#include <point_files/formats.h>
#include <point_files/text_lines.h>

namespace umbilic {

namespace {

enum class Encoding { text, little, big };
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    NumberType type = NumberType::float32;
    bool is_list = false;
    NumberType count_type = NumberType::uint8;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
    std::size_t bytes = 0;  ///< length of the header
    std::size_t lines = 0;
};

std::size_t size_of(NumberType type) {
    switch (type) {
        case NumberType::int8:
        case NumberType::uint8:
            return 1;
        case NumberType::int16:
        case NumberType::uint16:
            return 2;
        case NumberType::int32:
        case NumberType::uint32:
        case NumberType::float32:
            return 4;
        case NumberType::float64:
            return 8;
    }
    return 0;
}

std::optional<NumberType> type_named(std::string_view name) {
    if (name == "char" || name == "int8") return NumberType::int8;
    if (name == "uchar" || name == "uint8") return NumberType::uint8;
    if (name == "short" || name == "int16") return NumberType::int16;
    if (name == "ushort" || name == "uint16") return NumberType::uint16;
    if (name == "int" || name == "int32") return NumberType::int32;
    if (name == "uint" || name == "uint32") return NumberType::uint32;
    if (name == "float" || name == "float32") return NumberType::float32;
    if (name == "double" || name == "float64") return NumberType::float64;
    return {};
}

Header read_header(std::string_view bytes, const std::string& path) {
    Header header;
    TextLines lines(bytes);
    const auto type_of = [&](std::string_view word) {
        const auto type = type_named(word);
        if (!type) bad_line(path, lines.number(), "unknown number type '" + std::string(word) + "' in the PLY header");
        return *type;
    };
    bool has_format = false;
    lines.next();  // the word ply
    while (const auto line = lines.next()) {
        std::string_view rest = *line;
        const std::string_view word = take_word(rest);
        if (word == "format") {
            const std::string_view name = take_word(rest);
            if (name == "ascii")
                header.encoding = Encoding::text;
            else if (name == "binary_little_endian")
                header.encoding = Encoding::little;
            else if (name == "binary_big_endian")
                header.encoding = Encoding::big;
            else
                bad_line(path, lines.number(), "unknown PLY format '" + std::string(name) + "'");
            has_format = true;
        } else if (word == "element") {
            Element element{.name = std::string(take_word(rest))};
            const std::string_view count = take_word(rest);
            const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
            if (error != std::errc() || end != count.data() + count.size())
                bad_line(path, lines.number(), "the number of entries of '" + element.name + "' is no count");
            header.elements.push_back(std::move(element));
        } else if (word == "property") {
            if (header.elements.empty()) bad_line(path, lines.number(), "a property before any element");
            Property property;
            std::string_view type = take_word(rest);
            if (type == "list") {
                property.is_list = true;
                property.count_type = type_of(take_word(rest));
                type = take_word(rest);
            }
            property.type = type_of(type);
            property.name = std::string(take_word(rest));
            header.elements.back().properties.push_back(std::move(property));
        } else if (word == "end_header") {
            if (!has_format) bad_line(path, lines.number(), "the PLY header states no format");
            header.bytes = bytes.size() - lines.bytes_left();
            header.lines = lines.number();
            return header;
        } else if (word != "comment" && word != "obj_info" && !word.empty()) {
            bad_line(path, lines.number(), "unknown word '" + std::string(word.substr(0, 40)) + "' in the PLY header");
        }
    }
    bad_line(path, lines.number(), "the PLY header does not end; the file is cut off");
}

/// Gives the numbers of the body one after the other.
class Body {
public:
    Body(std::string_view bytes, const Header& header, const std::string& path)
        : bytes_(bytes),
          at_(header.bytes),
          encoding_(header.encoding),
          path_(path),
          line_(header.lines),
          rest_(bytes.substr(header.bytes)) {}

    double number(NumberType type) {
        if (encoding_ == Encoding::text) return text_number();
        const std::size_t size = size_of(type);
        if (left() < size) fail("the file is cut off; copy it again");
        const char* const at = bytes_.data() + at_;
        at_ += size;
        const std::endian order = encoding_ == Encoding::little ? std::endian::little : std::endian::big;
        switch (type) {
            case NumberType::int8:
                return binary_number<std::int8_t>(at, order);
            case NumberType::uint8:
                return binary_number<std::uint8_t>(at, order);
            case NumberType::int16:
                return binary_number<std::int16_t>(at, order);
            case NumberType::uint16:
                return binary_number<std::uint16_t>(at, order);
            case NumberType::int32:
                return binary_number<std::int32_t>(at, order);
            case NumberType::uint32:
                return binary_number<std::uint32_t>(at, order);
            case NumberType::float32:
                return binary_number<float>(at, order);
            case NumberType::float64:
                return binary_number<double>(at, order);
        }
        return 0.0;
    }

    /// A count or an index: a whole number not below 0.
    std::uint64_t whole(NumberType type, const char* what) {
        const double value = number(type);
        if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value)))
            fail(std::string(what) + " is no whole number; the file is damaged");
        return static_cast<std::uint64_t>(value);
    }

    /// Bytes that are left for numbers; each of them takes at least `size`.
    std::size_t left() const { return encoding_ == Encoding::text ? rest_.size() : bytes_.size() - at_; }
    std::size_t least_size(NumberType type) const { return encoding_ == Encoding::text ? 1 : size_of(type); }

    [[noreturn]] void fail(const std::string& what) const {
        if (encoding_ == Encoding::text) bad_line(path_, line_, what);
        throw InvalidInput(path_ + ": byte " + std::to_string(at_) + ": " + what);
    }

private:
    double text_number() {
        while (true) {
            const std::size_t start = std::min(rest_.find_first_not_of(" \t\r"), rest_.size());
            rest_.remove_prefix(start);
            if (rest_.empty()) fail("the file is cut off; copy it again");
            if (rest_.front() != '\n') break;
            rest_.remove_prefix(1);
            ++line_;
        }
        const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
        const auto value = number_in(word);
        if (!value) fail("'" + std::string(word.substr(0, 40)) + "' is no number; the file is damaged");
        rest_.remove_prefix(word.size());
        return *value;
    }

    std::string_view bytes_;
    std::size_t at_;
    Encoding encoding_;
    const std::string& path_;
    std::size_t line_;
    std::string_view rest_;
};

/// A header that promises more entries than the file has bytes for is refused before anything is allocated.
void check_count(const Element& element, const Body& body) {
    std::size_t least = 0;
    for (const Property& property : element.properties)
        least += body.least_size(property.is_list ? property.count_type : property.type);
    if (element.count > 0 && (least == 0 || element.count > body.left() / least))
        body.fail("the header promises " + std::to_string(element.count) + " entries of '" + element.name +
                  "', more than the file can hold; it is damaged or cut off");
}

/// What a property of the vertices or faces means to us.
enum class Role { none, x, y, z, nx, ny, nz, corners };

Role role_of(const Element& element, const Property& property) {
    const std::string& name = property.name;
    if (element.name == "face" && property.is_list && (name == "vertex_indices" || name == "vertex_index"))
        return Role::corners;
    if (element.name != "vertex" || property.is_list) return Role::none;
    constexpr std::array<std::pair<const char*, Role>, 6> names = {
        {{"x", Role::x}, {"y", Role::y}, {"z", Role::z}, {"nx", Role::nx}, {"ny", Role::ny}, {"nz", Role::nz}}};
    for (const auto& [known, role] : names)
        if (name == known) return role;
    return Role::none;
}

bool has(const std::vector<Role>& roles, std::initializer_list<Role> wanted) {
    return std::ranges::all_of(wanted, [&](Role role) { return std::ranges::find(roles, role) != roles.end(); });
}

/// Reads a list; of a face's corners it makes triangles.
void read_list(Body& body, const Property& property, bool corners, PointCloud& cloud) {
    const std::uint64_t entries = body.whole(property.count_type, "the length of a list");
    if (entries > body.left() / body.least_size(property.type))
        body.fail("a list is longer than the file; it is damaged or cut off");
    int first = 0, last = 0;
    for (std::uint64_t k = 0; k < entries; ++k) {
        if (!corners) {
            body.number(property.type);
            continue;
        }
        const std::uint64_t index = body.whole(property.type, "a corner of a face");
        if (index > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
            body.fail("a face refers to a vertex that is not there; the file is damaged");
        const int corner = static_cast<int>(index);
        if (k == 0) first = corner;
        if (k >= 2) cloud.triangles.push_back({first, last, corner});
        last = corner;
    }
}

void read_element(Body& body, const Element& element, PointCloud& cloud, const Progress& progress) {
    check_count(element, body);
    std::vector<Role> roles;
    for (const Property& property : element.properties) roles.push_back(role_of(element, property));
    const bool vertices = element.name == "vertex";
    if (vertices && !has(roles, {Role::x, Role::y, Role::z}))
        throw InvalidInput(cloud.source.path + ": the vertices have no x, y and z; export the points again");
    const bool normals = has(roles, {Role::nx, Role::ny, Role::nz});
    if (vertices) cloud.points.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        if (i % progress_interval == 0) progress.check();
        std::array<double, 6> value{};  // x, y, z, nx, ny, nz
        for (std::size_t k = 0; k < roles.size(); ++k) {
            const Property& property = element.properties[k];
            if (property.is_list) {
                read_list(body, property, roles[k] == Role::corners, cloud);
                continue;
            }
            const double number = body.number(property.type);
            if (roles[k] != Role::none) value[static_cast<int>(roles[k]) - static_cast<int>(Role::x)] = number;
        }
        if (vertices) cloud.points.emplace_back(value[0], value[1], value[2]);
        if (normals) cloud.normals.emplace_back(value[3], value[4], value[5]);
    }
}

}  // namespace

void read_ply(std::string_view bytes, PointCloud& cloud, const Progress& progress) {
    const Header header = read_header(bytes, cloud.source.path);
    cloud.layout = header.encoding == Encoding::text     ? "PLY text"
                   : header.encoding == Encoding::little ? "PLY binary little-endian"
                                                         : "PLY binary big-endian";
    Body body(bytes, header, cloud.source.path);
    for (const Element& element : header.elements) read_element(body, element, cloud, progress);
}

}  // namespace umbilic
