// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/foreign.h"

#include "preprocess/ingest/text.h"
#include "preprocess/input/input_formats.h"

namespace pointrt {
namespace {

/// Advice for files that are not supported.
constexpr std::string_view kUnpack = "unpack it first";
constexpr std::string_view kConvertScan = "convert it first, with CloudCompare or 'pdal translate'";
constexpr std::string_view kExportClouds = "save its clouds as LAS or PLY from CloudCompare, or with "
                                           "'CloudCompare -SILENT -O FILE.bin -C_EXPORT_FMT LAS -SAVE_CLOUDS'";
constexpr std::string_view kConvertGrid = "convert it first, with 'gdal_translate -of AAIGrid'";
constexpr std::string_view kConvertMesh =
    "convert it to PLY or OBJ first, with MeshLab or Blender; --sample N samples points";
constexpr std::string_view kConvertSplats = "export it as PLY, SPZ or SOG, for example from SuperSplat";
constexpr std::string_view kEncode = "convert it to UTF-8, for example with 'iconv -f UTF-16 -t UTF-8'";
constexpr std::string_view kNoScan = "it has no scan";
constexpr std::string_view kWebPage = "the download did not deliver the scan";

struct Foreign {
    std::string_view mark; ///< its first bytes, or its suffixes, separated by blanks
    std::string_view what, advice;
};

/// Scans and models in unsupported formats.
// clang-format off
constexpr Foreign kUnreadStarts[] = {
    {"[Expe/PointSet", "is an Expe point set", kConvertScan},
    {"\x89HDF", "is an HDF5 file", kConvertScan},
    {"CCB0", "is a CloudCompare project", kExportClouds}, // the digit says whether numbers are floats or doubles
    {"CCB1", "is a CloudCompare project", kExportClouds},
    {"CCB2", "is a CloudCompare project", kExportClouds},
    {"CCB3", "is a CloudCompare project", kExportClouds},
    {"DSAA", "is a Surfer grid", kConvertGrid},
    {"DSBB", "is a Surfer grid", kConvertGrid},
    {"DSRB", "is a Surfer grid", kConvertGrid},
    {"Kaydara FBX", "is an FBX model", kConvertMesh},
    {"BLENDER", "is a Blender file", kConvertMesh},
};
// clang-format on
/// The same, recognised by suffix: text, or bytes without a signature.
constexpr Foreign kUnreadSuffixes[] = {
    {"ksplat lcc", "is a file of Gaussian splats", kConvertSplats},
    {"fls fws lsproj", "is in a FARO format", "export it as E57 from FARO SCENE"},
    {"zfs zfprj", "is in a Z+F format", "export it as E57 from Z+F LaserControl"},
    {"rxp rdbx", "is in a RIEGL format", "export it as E57 or LAZ from RiSCAN PRO or RiPROCESS"},
    {"rcp rcs", "is in Autodesk ReCap's format", "export it as E57 from ReCap"},
    {"ptg imp lgs lgsx", "is in a Leica format", "export it as E57 from Leica Cyclone or Cyclone REGISTER 360"},
    {"tzf tzs", "is in a Trimble format", "export it as E57 from Trimble RealWorks"},
    {"dp", "is in DotProduct's format", "export it as E57, PTX or PLY from Dot3D"},
    {"clr cl3", "is in a Topcon format", "export it as E57 from MAGNET Collage or ScanMaster"},
    {"pod", "is in Bentley Pointools' format", "export it as E57 from Pointools or Descartes"},
    {"dae wrl x3d 3ds stp step igs iges dxf ifc", "is a 3D model", kConvertMesh},
};

/// Other files.
constexpr Foreign kOtherStarts[] = {
    {{"\x89PRO\r\n\x1a\n", 8}, // format/SPEC.md
     "is baked already",
     "pointrt-view shows it, pointrt-info --export writes its splats as PLY"},
    {"version https://git-lfs", "is a Git LFS pointer, not the data itself", "fetch it with 'git lfs pull'"},
    {"PK\x03\x04", "is a zip archive", kUnpack},
    {"7z\xbc\xaf\x27\x1c", "is a 7z archive", kUnpack},
    {"Rar!\x1a", "is a RAR archive", kUnpack},
    {"\xfd"
     "7zXZ",
     "is compressed with xz", kUnpack},
    {"\x28\xb5\x2f\xfd", "is compressed with zstd", kUnpack},
    {"BZh", "is compressed with bzip2", kUnpack},
    {"\xff\xfe", "is UTF-16 text", kEncode},
    {"\xfe\xff", "is UTF-16 text", kEncode},
    {"\x89PNG", "is a picture", kNoScan},
    {"\xff\xd8\xff", "is a picture", kNoScan},
    {"\x76\x2f\x31\x01", "is a picture", kNoScan},
    {"#?RADIANCE", "is a picture", kNoScan},
    {"%PDF-", "is a PDF document", kNoScan},
    {"<!DOCTYPE html", "is a web page", kWebPage},
    {"<!doctype html", "is a web page", kWebPage},
    {"<html", "is a web page", kWebPage},
};

[[noreturn]] void refuseUnread(const InputFile& input, const Foreign& foreign) {
    refuse(input, fmt::format("{}; this build reads {}: {}", foreign.what, readableFormats(), foreign.advice));
}

/// The header of the first member has the signature at byte 257.
bool isTar(std::string_view bytes) { return bytes.size() > 512 && bytes.substr(257).starts_with("ustar"); }

bool holdsWord(std::string_view words, std::string_view wanted) {
    for (std::string_view word = nextWord(words); !word.empty(); word = nextWord(words))
        if (word == wanted) return true;
    return false;
}

} // namespace

void refuseForeignStart(const InputFile& input) {
    for (const Foreign& foreign : kUnreadStarts)
        if (input.bytes.starts_with(foreign.mark)) refuseUnread(input, foreign);
    for (const Foreign& foreign : kOtherStarts)
        if (input.bytes.starts_with(foreign.mark)) refuse(input, fmt::format("{}: {}", foreign.what, foreign.advice));
    if (isTar(input.bytes)) refuse(input, fmt::format("is a tar archive: {}", kUnpack));
}

void refuseForeignSuffix(const InputFile& input, std::string_view suffix) {
    for (const Foreign& foreign : kUnreadSuffixes)
        if (holdsWord(foreign.mark, suffix)) refuseUnread(input, foreign);
    if (suffix == "toml") refuse(input, "is a scene file: render it with pointrt-view; bake the scans it names");
}

} // namespace pointrt
