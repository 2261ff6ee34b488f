// SPDX-License-Identifier: GPL-3.0-or-later
// Points whose values lie at regular places in memory: arrays of NumPy, VTK and 3D Tiles, ROS messages.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "preprocess/cloud/scalar.h"
#include "preprocess/ingest/dimensions.h"

namespace pointrt {

class Sink;
struct InputFile;

/// A value of each point, of one or more components.
struct FieldArray {
    std::string name; ///< as the file spells it
    Scalar type = Scalar::kF32;
    std::uint32_t components = 1;
    const char* first = nullptr;    ///< the first point's value
    std::size_t stride = 0;         ///< bytes from a point's value to the next point's
    std::size_t step = 0;           ///< bytes from a component to the next
    bool swapped = false;           ///< big-endian
    Dimension dimension = kIgnored; ///< of the first component, others follow; kIgnored: the field is an attribute
    bool packs_color = false;       ///< one component of 32 bits, whose bytes are blue, green and red
};

/// A field whose values follow one another without gaps.
FieldArray denseField(const std::string& name, Scalar type, std::uint32_t components, const char* first);

/// Finds dimensions by name: "x", "nx" or "red" for one component, "points", "normals" or "colors" for three; "rgb" of
/// one component is a packed colour. Incomplete normals and colours remain attributes.
void findDimensions(std::span<FieldArray> fields);

bool hasPositions(std::span<const FieldArray> fields);

/// Starts a scan and adds its points; the caller finishes it. Fields without a dimension become attributes; those with
/// more than 4 components or a duplicate name are listed in a note. Positions must be among the fields.
/// @param faces whether polygons will follow
void addFieldPoints(const InputFile& input, std::span<const FieldArray> fields, std::uint64_t count, Sink& sink,
                    bool faces = false);

/// The same in two steps: starts a scan of this many points (0: unknown) with fields like these, and adds points to it.
void beginFieldScan(const InputFile& input, std::span<const FieldArray> fields, std::uint64_t count, Sink& sink,
                    bool faces = false);
void addToFieldScan(std::span<const FieldArray> fields, std::uint64_t count, Sink& sink);

} // namespace pointrt
