// SPDX-License-Identifier: LGPL-2.1-or-later
#include "exchange.h"

#include <fstream>
#include <stdexcept>

#include <APIHeaderSection_MakeHeader.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_HArray1OfHAsciiString.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace umbilic::models {
namespace {

constexpr const char* kAuthor = "Umbilic";
constexpr const char* kStepDate = "2024-01-01T00:00:00";
constexpr const char* kIgesDate = "20240101.000000";

Handle(TCollection_HAsciiString) text(const std::string& value) {
    return new TCollection_HAsciiString{value.c_str()};
}

bool has_solid(const TopoDS_Shape& shape) {
    return TopExp_Explorer{shape, TopAbs_SOLID}.More();
}

void write_step(const TopoDS_Shape& shape, const std::string& part_name, const std::filesystem::path& path) {
    // Through a document, because the plain writer appends a running number to the name.
    const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
    Handle(TDocStd_Document) document;
    application->NewDocument("BinXCAF", document);
    const TDF_Label part = XCAFDoc_DocumentTool::ShapeTool(document->Main())->AddShape(shape, false);
    TDataStd_Name::Set(part, part_name.c_str());
    STEPCAFControl_Writer writer;
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    const bool transferred = writer.Transfer(document, STEPControl_AsIs);
    application->Close(document);
    if (!transferred) throw std::runtime_error(path.string() + ": STEP transfer failed");
    APIHeaderSection_MakeHeader header{writer.ChangeWriter().Model()};
    header.SetName(text(path.filename().string()));
    header.SetTimeStamp(text(kStepDate));
    header.SetAuthorValue(1, text(kAuthor));
    header.SetOrganizationValue(1, text(kAuthor));
    header.SetOriginatingSystem(text("generate_models"));
    if (writer.Write(path.c_str()) != IFSelect_RetDone) throw std::runtime_error(path.string() + ": cannot write");
}

void write_iges(const TopoDS_Shape& shape, const std::string& part_name, const std::filesystem::path& path) {
    IGESControl_Controller::Init();
    const int mode = has_solid(shape) ? 1 : 0;
    IGESControl_Writer writer{"MM", mode};
    if (!writer.AddShape(shape)) throw std::runtime_error(path.string() + ": IGES transfer failed");
    writer.ComputeModel();
    IGESData_GlobalSection header = writer.Model()->GlobalSection();
    header.SetSendName(text(part_name));
    header.SetFileName(text(path.filename().string()));
    header.SetAuthorName(text(kAuthor));
    header.SetCompanyName(text(kAuthor));
    header.SetReceiveName(text(part_name));
    header.SetDate(text(kIgesDate));
    header.SetLastChangeDate(text(kIgesDate));
    writer.Model()->SetGlobalSection(header);
    std::ofstream file{path, std::ios::binary};
    if (!writer.Write(file) || !file.flush()) throw std::runtime_error(path.string() + ": cannot write");
}

template <class Reader>
TopoDS_Shape read_with(Reader& reader, const std::filesystem::path& path) {
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw std::runtime_error(path.string() + ": cannot read");
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    if (shape.IsNull()) throw std::runtime_error(path.string() + ": no shape");
    return shape;
}

}  // namespace

void write_cad(const TopoDS_Shape& shape, const std::string& part_name, const std::filesystem::path& path) {
    if (path.extension() == ".step")
        write_step(shape, part_name, path);
    else
        write_iges(shape, part_name, path);
}

TopoDS_Shape read_cad(const std::filesystem::path& path) {
    if (path.extension() == ".step") {
        STEPControl_Reader reader;
        return read_with(reader, path);
    }
    IGESControl_Reader reader;
    return read_with(reader, path);
}

}  // namespace umbilic::models
