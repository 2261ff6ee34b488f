// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/foreign.h"

#include "preprocess/input/formats.h"
#include "preprocess/input/scalar.h"
#include "preprocess/input/text.h"

namespace pointrt {
namespace {

/// What to do with a file that is not read, apart from the list of what is.
constexpr std::string_view kUnpack = "unpack it first";
constexpr std::string_view kConvertScan = "convert it first, with CloudCompare or 'pdal translate'";
constexpr std::string_view kConvertMesh =
    "convert it to PLY or OBJ first, with MeshLab or Blender; --sample N spreads points";
constexpr std::string_view kConvertSplats = "export it as PLY or SPZ, from SuperSplat for one";
constexpr std::string_view kEncode = "save it as UTF-8 or ASCII, as 'iconv -f UTF-16 -t UTF-8' does";
constexpr std::string_view kNoScan = "it holds no scan";
constexpr std::string_view kWebPage = "what was to be downloaded is not in it";

struct Foreign {
    std::string_view mark; ///< its first bytes, or its suffixes with a blank between two
    std::string_view what, advice;
};

/// Scans and models in formats that are not read.
constexpr Foreign kUnreadStarts[] = {
    {"[Expe/PointSet", "is an Expe point set", kConvertScan}, {"\x89HDF", "is an HDF5 file", kConvertScan},
    {"# vtk DataFile", "is a VTK file", kConvertMesh},        {"glTF", "is a glTF model", kConvertMesh},
    {"Kaydara FBX", "is an FBX model", kConvertMesh},         {"BLENDER", "is a Blender file", kConvertMesh},
};
/// The same, of text or of bytes without a mark.
constexpr Foreign kUnreadSuffixes[] = {
    {"ksplat sog lcc", "is a file of Gaussian splats", kConvertSplats},
    {"fls rcp rcs zfs", "is a scanner maker's file", "export it as PLY or text from the maker's program"},
    {"gltf dae wrl x3d 3ds stp step igs iges dxf ifc", "is a 3D model", kConvertMesh},
};

/// What is no scan, or not yet one.
constexpr Foreign kOtherStarts[] = {
    {{"\x89PRO\r\n\x1a\n", 8}, // format/SPEC.md
     "is baked already",
     "pointrt-view shows it, pointrt-info --export gives its splats as PLY"},
    {"version https://git-lfs", "is a Git LFS pointer, not the data itself", "fetch it with 'git lfs pull'"},
    {"PK\x03\x04", "is a zip archive", kUnpack},
    {"7z\xbc\xaf\x27\x1c", "is a 7z archive", kUnpack},
    {"Rar!\x1a", "is a RAR archive", kUnpack},
    {"\xfd"
     "7zXZ",
     "is packed with xz", kUnpack},
    {"\x28\xb5\x2f\xfd", "is packed with zstd", kUnpack},
    {"BZh", "is packed with bzip2", kUnpack},
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

[[noreturn]] void refuseUnread(const Source& source, const Foreign& foreign) {
    refuse(source, fmt::format("{}; this build reads {}: {}", foreign.what, readableFormats(), foreign.advice));
}

/// A header of 80 bytes, the number of triangles, 50 bytes for each.
bool isBinaryStl(std::string_view bytes) {
    constexpr std::size_t kHeader = 84, kTriangle = 50;
    if (bytes.size() < kHeader + kTriangle || (bytes.size() - kHeader) % kTriangle != 0) return false;
    return loadScalar(bytes.data() + 80, Scalar::kU32, false) ==
           static_cast<double>((bytes.size() - kHeader) / kTriangle);
}

/// "solid NAME" and, on the next line, "facet normal x y z".
bool isTextStl(std::string_view bytes) {
    std::string_view line;
    if (nextWord(bytes) != "solid" || !nextLine(bytes, line)) return false;
    const std::string_view word = nextWord(bytes);
    return word == "facet" || word == "endsolid";
}

/// The first member's header names the format, 257 bytes into it.
bool isTar(std::string_view bytes) { return bytes.size() > 512 && bytes.substr(257).starts_with("ustar"); }

bool holdsWord(std::string_view words, std::string_view wanted) {
    for (std::string_view word = nextWord(words); !word.empty(); word = nextWord(words))
        if (word == wanted) return true;
    return false;
}

} // namespace

void refuseForeignStart(const Source& source) {
    for (const Foreign& foreign : kUnreadStarts)
        if (source.bytes.starts_with(foreign.mark)) refuseUnread(source, foreign);
    if (isTextStl(source.bytes) || isBinaryStl(source.bytes))
        refuseUnread(source, {"", "is an STL mesh", kConvertMesh});
    for (const Foreign& foreign : kOtherStarts)
        if (source.bytes.starts_with(foreign.mark)) refuse(source, fmt::format("{}: {}", foreign.what, foreign.advice));
    if (isTar(source.bytes)) refuse(source, fmt::format("is a tar archive: {}", kUnpack));
}

void refuseForeignSuffix(const Source& source, std::string_view suffix) {
    for (const Foreign& foreign : kUnreadSuffixes)
        if (holdsWord(foreign.mark, suffix)) refuseUnread(source, foreign);
    if (suffix == "toml") refuse(source, "is a scene file: pointrt-view renders it; bake the scans that it names");
}

} // namespace pointrt
