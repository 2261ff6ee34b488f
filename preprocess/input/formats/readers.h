// SPDX-License-Identifier: GPL-3.0-or-later
// One reader per format. Each throws Error with "FILE[:PLACE]: reason" when the source is malformed.
#pragma once

#include "preprocess/input/source/sink.h"

namespace pointrt {

/// For messages about inputs of other kinds.
constexpr const char* kReadableFormats = "PLY, PCD, XYZ/PTS/ASC/TXT/CSV, OBJ, OFF, Draco and Stanford .conf";

/// Stanford polygon files: ascii and binary of both byte orders, faces and tristrips.
void readPly(const Source& source, Sink& sink);

/// Point Cloud Library files, versions .5 to .7: ascii, binary, binary_compressed.
void readPcd(const Source& source, Sink& sink);

/// Text with a point a line: xyz, pts, asc, txt, csv.
void readXyz(const Source& source, Sink& sink);

/// Wavefront: vertices, their colours, normals and faces.
void readObj(const Source& source, Sink& sink);

/// Object file format of Geomview: OFF, COFF, NOFF, CNOFF, as text.
void readOff(const Source& source, Sink& sink);

/// Draco point clouds and meshes.
void readDraco(const Source& source, Sink& sink);

/// Stanford .conf: reads the scans that its bmesh lines name, beside it, each with its pose and sensor.
void readConf(const Source& source, Sink& sink);

} // namespace pointrt
