// SPDX-License-Identifier: GPL-3.0-or-later
// The supported formats. To add one: a file that defines its FormatReader, and a row here.
#pragma once

#include <string_view>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Possible contents of a file.
enum class Content {
    kAny,     ///< text or binary, recognised by its start or a header line
    kText,    ///< text only, recognised by a line
    kColumns, ///< text that no other format recognises
};

/// The code of a format.
struct FormatReader {
    /// Recognises the format by a file's first bytes; null if it has no signature.
    bool (*isStart)(std::string_view bytes) = nullptr;
    /// Recognises the format by a line of text that is not a comment; null if no line identifies it. first: it is the
    /// first line of the file
    bool (*isLine)(std::string_view line, bool first) = nullptr;
    /// Throws Error with "FILE[:PLACE]: reason" if the input is malformed.
    void (*read)(const InputFile& input, Sink& sink);
    /// Whether the file can be read into batches: it has no faces, no grid, nothing that needs all points at once. Null
    /// if no file of the format can.
    bool (*readsInBatches)(const InputFile& input) = nullptr;
    /// Files may have levels of detail: read() honours Sink::level and adds a note if a file has none.
    bool has_levels = false;
};

/// FormatReader::readsInBatches of formats whose files always can be.
inline bool alwaysInBatches(const InputFile&) { return true; }

/// The list of formats: reader, name for --input-format, title, suffixes in lower case, content. The option, help,
/// messages and detection use it. A format's file defines "const FormatReader readers::kName{...}", which compiles only
/// for a name in this list; a name without a definition does not link.
// clang-format off
#define POINTRT_INPUT_FORMATS(FORMAT)                                                                                  \
    FORMAT(kPly, "ply", "PLY", "ply", kAny)                                                                            \
    FORMAT(kPcd, "pcd", "PCD", "pcd", kAny)                                                                            \
    FORMAT(kLas, "las", "LAS/LAZ", "las laz", kAny)                                                                    \
    FORMAT(kE57, "e57", "E57", "e57", kAny)                                                                            \
    FORMAT(kPtx, "ptx", "PTX", "ptx", kText)                                                                           \
    FORMAT(kXyz, "xyz", "XYZ/PTS/ASC/TXT/CSV", "xyz pts asc txt csv", kColumns)                                        \
    FORMAT(kObj, "obj", "OBJ", "obj", kText)                                                                           \
    FORMAT(kOff, "off", "OFF", "off", kText)                                                                           \
    FORMAT(kStl, "stl", "STL", "stl", kAny)                                                                            \
    FORMAT(kVtk, "vtk", "VTK", "vtk vtp vtu", kAny)                                                                    \
    FORMAT(kDraco, "drc", "Draco", "drc", kAny)                                                                        \
    FORMAT(kGltf, "gltf", "glTF/GLB", "gltf glb", kAny)                                                                \
    FORMAT(kSplat, "splat", "SPLAT", "splat", kAny)                                                                    \
    FORMAT(kSpz, "spz", "SPZ", "spz", kAny)                                                                            \
    FORMAT(kSog, "sog", "SOG", "sog", kAny)                                                                            \
    FORMAT(kEpt, "ept", "EPT", "ept", kAny)                                                                            \
    FORMAT(kPotree, "potree", "Potree 2", "potree", kAny)                                                              \
    FORMAT(kPnts, "pnts", "3D Tiles", "pnts", kAny)                                                                    \
    FORMAT(kMcap, "mcap", "MCAP", "mcap", kAny)                                                                        \
    FORMAT(kRosbag, "rosbag", "ROS bag", "bag", kAny)                                                                  \
    FORMAT(kColmap, "colmap", "COLMAP", "colmap", kAny)                                                                \
    FORMAT(kNumPy, "numpy", "NumPy", "npy npz", kAny)                                                                  \
    FORMAT(kGeoTiff, "geotiff", "GeoTIFF", "tif tiff", kAny)                                                           \
    FORMAT(kEsriGrid, "grid", "ESRI grid", "agr", kText)                                                               \
    FORMAT(kKitti, "kitti", "KITTI", "bin", kAny)                                                                      \
    FORMAT(kConf, "conf", "Stanford .conf", "conf", kText)
// clang-format on

namespace readers {
#define POINTRT_DECLARE_READER(reader, ...) extern const FormatReader reader;
POINTRT_INPUT_FORMATS(POINTRT_DECLARE_READER)
#undef POINTRT_DECLARE_READER
} // namespace readers

/// Adds a note that a file has no levels of detail.
inline void noteWithoutLevels(const InputFile& input, Sink& sink) {
    sink.note(input, "has no levels of detail: all of it is read");
}

} // namespace pointrt
