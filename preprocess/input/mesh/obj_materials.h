// SPDX-License-Identifier: GPL-3.0-or-later
// The materials of OBJ models: colours and textures of MTL files.
#pragma once

#include <map>
#include <string>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// How the faces of a material are painted.
struct ObjMaterial {
    std::uint32_t picture = FacePaint::kNone; ///< as FacePaint::picture
    Rgb8 color{};
};

struct ObjMaterials {
    std::map<std::string, ObjMaterial, std::less<>> by_name;
    std::size_t files = 0; ///< read so far
};

/// Reads the files that an "mtllib" line names: Kd is a material's colour, map_Kd its texture, which replaces it. Adds
/// a note for each file that is not there.
/// @param names the rest of the line: one file, whose name may have blanks, or several
void readObjMaterials(const InputFile& input, std::string_view names, ObjMaterials& materials, Sink& sink);

} // namespace pointrt
