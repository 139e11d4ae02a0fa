// SPDX-License-Identifier: LGPL-2.1-or-later
#include "file_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include <openssl/evp.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

constexpr std::string_view step_header = "ISO-10303-21";
constexpr std::size_t iges_section = 72;  ///< column of the section's letter, from 0
constexpr std::size_t read_piece = std::size_t(1) << 20;

std::string whole_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InvalidInput(path + ": cannot be opened (" + std::strerror(errno) + "); check its permissions");
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (in.bad()) throw InvalidInput(path + ": reading it failed; copy it again from where it came");
    return text;
}

std::string_view without_leading_space(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

/// Lines of a text, with or without carriage returns.
template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find_first_of("\r\n");
        visit(text.substr(0, end), number);
        if (end == std::string_view::npos) return;
        text.remove_prefix(end + (text.substr(end, 2) == "\r\n" ? 2 : 1));
    }
}

std::optional<FileFormat> format_of(std::string_view text) {
    const std::string_view start = without_leading_space(text);
    if (start.starts_with(step_header)) return FileFormat::step;
    if (start.starts_with("DBRep_DrawableShape") || start.starts_with("CASCADE Topology V"))
        return FileFormat::brep_text;
    if (start.starts_with("Open CASCADE Topology V")) return FileFormat::brep_binary;
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    if (line.size() > iges_section && (line[iges_section] == 'S' || line[iges_section] == 'C')) return FileFormat::iges;
    return std::nullopt;
}

std::optional<FileFormat> format_of_ending(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".step" || ending == ".stp" || ending == ".p21") return FileFormat::step;
    if (ending == ".iges" || ending == ".igs") return FileFormat::iges;
    if (ending == ".brep" || ending == ".brp" || ending == ".rle") return FileFormat::brep_text;
    if (ending == ".bbrep" || ending == ".bin" || ending == ".brb") return FileFormat::brep_binary;
    return std::nullopt;
}

const char* format_name(FileFormat format) {
    switch (format) {
        case FileFormat::step:
            return "STEP";
        case FileFormat::iges:
            return "IGES";
        case FileFormat::brep_text:
            return "BREP text";
        case FileFormat::brep_binary:
            return "BREP binary";
    }
    return "";
}

bool is_name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Walks through a STEP file outside of its strings and comments.
struct StepScan {
    int faces = 0;
    int sections_ended = 0;
    bool ended = false;

    explicit StepScan(std::string_view text) {
        for (std::size_t i = 0; i < text.size();) {
            if (text[i] == '\'') {
                i = std::min(text.find('\'', i + 1), text.size() - 1) + 1;
            } else if (text.substr(i, 2) == "/*") {
                const std::size_t end = text.find("*/", i + 2);
                i = end == std::string_view::npos ? text.size() : end + 2;
            } else if (is_name_character(text[i])) {
                std::size_t end = i;
                while (end < text.size() && (is_name_character(text[end]) || text[end] == '-')) ++end;
                word(text.substr(i, end - i));
                i = end;
            } else {
                ++i;
            }
        }
    }

    void word(std::string_view name) {
        if (name == "ADVANCED_FACE" || name == "FACE_SURFACE") ++faces;
        if (name == "ENDSEC") ++sections_ended;
        if (name == "END-ISO-10303-21") ended = true;
    }
};

void describe_step(const std::string& path, std::string_view text, FileDescription& result) {
    const StepScan scan(text);
    // One section is the header, the other the data.
    if (!scan.ended && scan.sections_ended < 2)
        throw InvalidInput(path +
                           ": the STEP file is cut off (it has no ENDSEC and END-ISO-10303-21 at its end); get "
                           "the whole file or export it again");
    if (!scan.ended) result.warnings.push_back("the file does not end with END-ISO-10303-21");
    // Surfaces that stand alone become faces, too, so a file without a face declares nothing about their number.
    if (scan.faces > 0) result.declared_faces = scan.faces;
}

std::optional<int> iges_integer(std::string_view field) {
    const std::size_t start = field.find_first_not_of(' ');
    if (start == std::string_view::npos) return 0;
    field.remove_prefix(start);
    int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || field.find_first_not_of(' ', end - field.data()) != std::string_view::npos)
        return std::nullopt;
    return value;
}

bool is_iges_surface(int type) {
    constexpr std::array types = {108, 114, 118, 120, 122, 128, 140, 143, 144, 190, 192, 194, 196, 198, 510};
    return std::find(types.begin(), types.end(), type) != types.end();
}

void describe_iges(const std::string& path, std::string_view text, FileDescription& result) {
    std::array<int, 256> lines{};
    int faces = 0, misplaced = 0;
    std::size_t first_misplaced = 0;
    std::string_view first_of_entry;
    for_each_line(text, [&](std::string_view line, std::size_t number) {
        if (line.size() <= iges_section) return;
        const char section = line[iges_section];
        ++lines[static_cast<unsigned char>(section)];
        if (section == 'D') {
            if (lines['D'] % 2 == 1) {
                first_of_entry = line;
            } else {
                const int type = iges_integer(first_of_entry.substr(0, 8)).value_or(0);
                // Status number, columns 65-72: blank, subordinate, use, hierarchy, two digits each.
                const int subordinate = iges_integer(first_of_entry.substr(66, 2)).value_or(0);
                const bool physically_dependent = subordinate == 1 || subordinate == 3;
                if (is_iges_surface(type) && (type == 510 || !physically_dependent)) ++faces;
            }
        }
        if (section == 'P' && !iges_integer(line.substr(64, 8))) {
            if (misplaced++ == 0) first_misplaced = number;
        }
    });
    if (lines['T'] == 0)
        throw InvalidInput(path + ": the IGES file is cut off in its " +
                           (lines['P'] > 0   ? "parameter data"
                            : lines['D'] > 0 ? "directory"
                                             : "header") +
                           " (it has no terminate line); get the whole file or export it again");
    result.declared_faces = faces;
    if (misplaced > 0)
        result.warnings.push_back("line " + std::to_string(first_misplaced) +
                                  " runs over into columns 65 to 72, which belong to the pointer (" +
                                  std::to_string(misplaced) + " such lines)");
}

}  // namespace

FileDescription describe_file(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw InvalidInput(path + ": there is no such file; check the path");
    if (status.type() == std::filesystem::file_type::directory)
        throw InvalidInput(path + ": is a folder; name a file in it");
    if (status.type() != std::filesystem::file_type::regular)
        throw InvalidInput(path + ": is not a regular file" + (error ? " (" + error.message() + ")" : "") +
                           "; name a STEP, IGES or BREP file");
    const std::string text = whole_file(path);
    if (text.empty()) throw InvalidInput(path + ": is empty; export it again");

    const std::optional<FileFormat> format = format_of(text);
    if (!format)
        throw InvalidInput(path +
                           ": is neither STEP nor IGES nor BREP by its content; export it in one of these "
                           "formats");
    FileDescription result;
    result.format = *format;
    result.bytes = text.size();
    const std::optional<FileFormat> ending = format_of_ending(path);
    const auto is_brep = [](FileFormat f) { return f == FileFormat::brep_text || f == FileFormat::brep_binary; };
    if (ending && *ending != *format && !(is_brep(*ending) && is_brep(*format)))
        result.warnings.push_back(std::string("the content is ") + format_name(*format) + ", but the ending says " +
                                  format_name(*ending));
    if (*format == FileFormat::step) describe_step(path, text, result);
    if (*format == FileFormat::iges && text[iges_section] == 'S') describe_iges(path, text, result);
    return result;
}

std::string sha256_of_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
    if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1)
        throw NumericFailure("SHA-256 is not available from libcrypto");
    std::string piece(read_piece, '\0');
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        EVP_DigestUpdate(context.get(), piece.data(), static_cast<std::size_t>(in.gcount()));
    }
    if (!in.eof()) throw InvalidInput(path + ": reading it failed; copy it again from where it came");
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    EVP_DigestFinal_ex(context.get(), digest.data(), &size);
    constexpr char digits[] = "0123456789abcdef";
    std::string result;
    for (unsigned int i = 0; i < size; ++i) {
        result.push_back(digits[digest[i] >> 4]);
        result.push_back(digits[digest[i] & 15]);
    }
    return result;
}

}  // namespace umbilic
