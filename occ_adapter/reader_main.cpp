// SPDX-License-Identifier: LGPL-2.1-or-later
// The program that touches CAD files, so that a file can end no other one: see reader_process.h for its frames.
// umbilic_reader MEMORY read PATH DEFLECTION | MEMORY transform PATH OUT 12 numbers (rows of a 3 x 4 matrix)
//                | MEMORY write PATH OUT (a model in Umbilic's own form to STEP)
//                | MEMORY curves PATH OUT (points of curves, as doubles behind their counts, to STEP)
#include <bit>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <gp_Trsf.hxx>

#include <umbilic/core/errors.h>
#include <umbilic/model/serialization.h>

#include "curves_to_shape.h"
#include "file_format.h"
#include "model_to_shape.h"
#include "reader_process.h"
#include "shape_file.h"
#include "shape_to_model.h"

namespace {

using namespace umbilic;

/// Share of the whole time the kernel's reading takes, for the progress bar.
constexpr double reading_share = 0.5;

void write_all(const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t written = ::write(reader_output, bytes, size);
        // The caller is gone: nobody wants the result.
        if (written < 0) ::_exit(EXIT_FAILURE);
        bytes += written;
        size -= static_cast<std::size_t>(written);
    }
}

void send(char letter, const std::string& contents) {
    std::string header(1, letter);
    for (int i = 0; i < 8; ++i)
        header.push_back(static_cast<char>(static_cast<std::uint64_t>(contents.size()) >> (8 * i) & 0xff));
    write_all(header.data(), header.size());
    write_all(contents.data(), contents.size());
}

/// Says that memory is exhausted without asking for any.
[[noreturn]] void out_of_memory() {
    const char frame[reader_frame::header_size] = {reader_frame::out_of_memory};
    write_all(frame, sizeof frame);
    ::_exit(EXIT_FAILURE);
}

bool send_progress(double fraction, std::string_view stage) {
    std::string contents;
    const auto bits = std::bit_cast<std::uint64_t>(fraction);
    for (int i = 0; i < 8; ++i) contents.push_back(static_cast<char>(bits >> (8 * i) & 0xff));
    contents += stage;
    send(reader_frame::progress, contents);
    return true;
}

void limit_memory(std::uint64_t bytes) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__)  // whose shadow memory is larger than any limit
    const rlimit memory{bytes, bytes};
    if (bytes > 0) ::setrlimit(RLIMIT_AS, &memory);
#else
    static_cast<void>(bytes);
#endif
}

double number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') throw InvalidInput("umbilic_reader: not a number: " + text);
    return value;
}

/// Number of distinct faces, instances of a part counted once, as a file's text declares them.
int distinct_faces(const TopoDS_Shape& shape) {
    TopTools_MapOfShape faces;
    for (TopExp_Explorer explorer(shape, TopAbs_FACE); explorer.More(); explorer.Next())
        faces.Add(explorer.Current().Located(TopLoc_Location()));
    return faces.Extent();
}

ShapeFile read_checked(const std::string& path, const FileDescription& description, const Progress& progress) {
    ShapeFile file = read_shape_file(path, description, progress);
    if (!file.shape.IsNull() && distinct_faces(file.shape) > 0) return file;
    std::string why = "OpenCASCADE reads no face from it";
    if (description.declared_faces > 0) why += ", though it declares " + std::to_string(description.declared_faces);
    for (const std::string& warning : description.warnings) why += "; " + warning;
    if (!file.first_complaint.empty()) why += "; OpenCASCADE says: " + file.first_complaint;
    throw InvalidInput(why + " — open it in the system that wrote it and export its surfaces again");
}

void add_file_facts(const ShapeFile& file, const FileDescription& description, Model& model) {
    model.source.format = file.format;
    model.source.unit = file.unit;
    model.source.unit_in_mm = file.unit_in_mm;
    model.source.bytes = description.bytes;
    model.declared_faces = description.declared_faces;
    const int arrived = distinct_faces(file.shape);
    if (arrived < description.declared_faces)
        model.warnings.push_back("the file declares " + std::to_string(description.declared_faces) +
                                 " faces, but only " + std::to_string(arrived) + " arrived");
    model.warnings.insert(model.warnings.end(), description.warnings.begin(), description.warnings.end());
    model.warnings.insert(model.warnings.end(), file.warnings.begin(), file.warnings.end());
    for (Face& face : model.faces) {
        if (const auto name = file.face_names.find(face.number); name != file.face_names.end())
            face.name = name->second;
        if (const auto color = file.face_colors.find(face.number); color != file.face_colors.end())
            face.color = color->second;
    }
    for (std::size_t i = 0; i < model.solids.size(); ++i)
        if (const auto name = file.solid_names.find(static_cast<int>(i) + 1); name != file.solid_names.end())
            model.solids[i].name = name->second;
}

std::string read(const std::string& path, double deflection) {
    const Progress progress(send_progress);
    const FileDescription description = describe_file(path);
    const ShapeFile file = read_checked(path, description, progress.part(0.0, reading_share));
    Model model = shape_to_model(file.shape, progress.part(reading_share, 0.9));
    add_file_facts(file, description, model);
    model.source.sha256 = sha256_of_file(path);
    std::vector<DisplayMesh> meshes;
    if (deflection > 0.0) {
        progress.report(0.9, "triangulating for display");
        meshes = display_meshes(file.shape, deflection * model.box.diagonal(), model);
    }
    std::ostringstream out;
    write_model(model, out);
    write_display_meshes(meshes, out);
    return out.str();
}

void write_step(const TopoDS_Shape& shape, const std::string& step_path) {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", "MM");
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
        throw NumericFailure("OpenCASCADE cannot translate the shape to STEP");
    if (writer.Write(step_path.c_str()) != IFSelect_RetDone)
        throw InvalidInput("the shape cannot be written to " + step_path + "; choose another place");
}

void transform(const std::string& path, const std::string& step_path, const std::vector<double>& m) {
    const ShapeFile file = read_checked(path, describe_file(path), Progress());
    gp_Trsf trsf;
    trsf.SetValues(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
    const TopoDS_Shape moved = BRepBuilderAPI_Transform(file.shape, trsf, Standard_True).Shape();
    write_step(moved, step_path);
}

void write(const std::string& path, const std::string& step_path) {
    std::ifstream in(path, std::ios::binary);
    write_step(shape_of(read_model(in)), step_path);
}

void write_curves(const std::string& path, const std::string& step_path) {
    std::ifstream in(path, std::ios::binary);
    std::vector<std::vector<Vector3>> curves;
    for (double count = 0.0; in.read(reinterpret_cast<char*>(&count), sizeof count);) {
        std::vector<Vector3> curve(static_cast<std::size_t>(count));
        for (Vector3& p : curve) in.read(reinterpret_cast<char*>(p.data()), 3 * sizeof(double));
        if (!in) throw InvalidInput("the points of a curve are cut off");
        curves.push_back(std::move(curve));
    }
    write_step(shape_of(curves), step_path);
}

std::string run(const std::vector<std::string>& words) {
    if (words.size() == 4 && words[1] == "read") return read(words[2], number(words[3]));
    if (words.size() == 16 && words[1] == "transform") {
        std::vector<double> matrix;
        for (std::size_t i = 4; i < words.size(); ++i) matrix.push_back(number(words[i]));
        transform(words[2], words[3], matrix);
        return "";
    }
    if (words.size() == 4 && words[1] == "write") {
        write(words[2], words[3]);
        return "";
    }
    if (words.size() == 4 && words[1] == "curves") {
        write_curves(words[2], words[3]);
        return "";
    }
    throw InvalidInput("umbilic_reader is started by Umbilic only");
}

/// One line; the caller puts the path before it itself.
std::string message_of(const std::string& text, const std::vector<std::string>& words) {
    const std::string path = words.size() > 2 ? words[2] + ": " : "";
    std::istringstream in(!path.empty() && text.starts_with(path) ? text.substr(path.size()) : text);
    std::string result, word;
    while (in >> word) result += (result.empty() ? "" : " ") + word;
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 2) return EXIT_FAILURE;
    limit_memory(std::strtoull(words[0].c_str(), nullptr, 10));
    std::set_new_handler(out_of_memory);
    Message::DefaultMessenger()->ChangePrinters().Clear();
    try {
        send(reader_frame::result, run(words));
        // Destructors of a kernel that has read a malformed file may crash: the result is out, so leave them.
        ::_exit(EXIT_SUCCESS);
    } catch (const InvalidInput& error) {
        send(reader_frame::invalid_input, message_of(error.what(), words));
    } catch (const Unsupported& error) {
        send(reader_frame::unsupported, message_of(error.what(), words));
    } catch (const Error& error) {
        send(reader_frame::numeric_failure, message_of(error.what(), words));
    } catch (const Standard_OutOfMemory&) {
        out_of_memory();
    } catch (const std::bad_alloc&) {
        out_of_memory();
    } catch (const Standard_Failure& failure) {
        const char* text = failure.GetMessageString();
        const std::string why =
            std::string(failure.DynamicType()->Name()) + (text && *text ? ": " : "") + (text ? text : "");
        send(reader_frame::invalid_input,
             message_of("OpenCASCADE cannot read it (" + why +
                            ") — it is malformed: open it in the system that wrote it and export again",
                        words));
    } catch (const std::exception& error) {
        send(reader_frame::invalid_input, message_of("cannot be read (" + std::string(error.what()) +
                                                         ") — open it in the system that wrote it and export again",
                                                     words));
    }
    ::_exit(EXIT_FAILURE);
}
