// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the pictures of textures: PNG, JPEG and WebP.
#pragma once

#include <optional>
#include <string>

#include "preprocess/ingest/mesh_paint.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Decodes a picture. Throws Error "NAME: reason" if it is malformed, of another format, or has more bytes of pixels
/// than 256 MiB plus 192 times its file's size.
Picture readPicture(const InputFile& file);

/// Reads the picture that an input names, from the input's folder, and adds it to the sink's paint. Returns its index
/// there. If it is missing or malformed, adds a note and returns nothing.
std::optional<std::uint32_t> addTexture(const InputFile& input, const std::string& name, Sink& sink);

/// Adds a picture that a file holds or names. key: distinguishes the pictures of a run. If it is malformed, adds a note
/// and returns nothing.
std::optional<std::uint32_t> addPicture(const InputFile& input, const InputFile& picture, const std::string& key,
                                        Sink& sink);

/// Adds a note that a texture cannot be read.
void noteUnreadTexture(const InputFile& input, const Error& error, Sink& sink);

/// Opens a file that an input names, perhaps with a path of another machine: the path itself if it lies in the input's
/// folder, else a file there with its last part, in upper or lower case. Nothing if there is no such file.
std::optional<InputFile> openBeside(const InputFile& input, std::string name);

} // namespace pointrt
