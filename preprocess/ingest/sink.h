// SPDX-License-Identifier: GPL-3.0-or-later
// Receives vertices and faces from the readers: transforms, filters and stores them, one file after another.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/batches.h"
#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/grid.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/no_data.h"
#include "preprocess/ingest/point_filter.h"
#include "preprocess/ingest/scan_transform.h"

namespace pointrt {

/// Options that apply to all files.
struct SinkOptions {
    AttributeChoice attributes = {};
    FilterOptions filter = {};
    std::optional<Eigen::Affine3d> world_from_input = {}; ///< of all files; applied after their poses
    std::optional<int> level = {};                        ///< finest level of files with levels of detail
    double skim = 1;                 ///< share of each chunk of LAZ files to read, above 0: for previews
    bool scales_degrees = false;     ///< degrees will be scaled to metres if all files are in degrees
    bool gaussians_as_discs = false; ///< opaque discs in place of Gaussians
    bool salvages = false;           ///< read the complete points of truncated files
    bool drops_withheld = false;     ///< leave out points that their file flags as withheld
};

/// The attribute that flags points as withheld, in LAS files.
inline constexpr const char* kWithheld = "withheld";

/// Points without data of a finished scan. They are still in the cloud, unless known_no_data contains them.
struct ScanNoData {
    std::size_t scan = 0; ///< index in Sink::scans
    NoData points;
    Eigen::Affine3d scan_from_world;
};

/// Whether a scan may have no points: one of several scans in a file may, as long as another has some.
enum class Emptiness { kRefused, kAllowed };

class Sink {
public:
    /// A sink whose cloud keeps all points.
    explicit Sink(Cloud& all_files, const SinkOptions& options = {});
    /// A sink that hands points on in batches; the cloud holds the current batch.
    Sink(Cloud& all_files, const SinkOptions& options, BatchOptions batches);
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;

    /// Starts a scan: a file, or one of several scans in it. Throws Error if the cloud would have more points than
    /// 32-bit indices distinguish, or if classes are selected and the file has none.
    void beginScan(const InputFile& input, const ScanTraits& traits);

    /// Adds one vertex, given in the scan's frame. Drops and counts a position that is not finite, in double precision
    /// or once rounded to float, or has a coordinate of 1e25 or more; also drops, and counts separately, one that the
    /// filter rejects.
    /// @param values packed values of the traits' columns, in their types; null if there are no columns
    /// @return its index in the cloud (meaningful only if holdsScan()), or what a range grid stores for it:
    /// RangeGrid::kNoPoint if it is not finite, kFilteredOut if the filter rejects it
    std::uint32_t addVertex(const Row& row, const char* values = nullptr);

    /// Adds many vertices that have no normals, radii or faces, and 16-bit colours or none: the same as adding them one
    /// by one, but several times as fast.
    /// @param arrays for each of the traits' columns an array of its values, in vertex order
    void addVertices(std::span<const Vec3d> positions, std::span<const char* const> arrays);

    /// Counts, as filtered, a vertex that the reader itself leaves out.
    void skipVertex() { scan_.faces.drop(scan_.vertices++); }

    /// Adds a polygon of 3 or more file indices, each below the file's number of vertices, as a fan of triangles.
    /// @param color may be absent; its places are one per corner
    void addPolygon(std::span<const std::uint32_t> corners, const PolygonPaint& color = {}) {
        ScanFaces::addPolygon(cloud, corners, transform.mirrors(), color, paint);
    }

    /// Ends a scan: scales its colours, removes faces with dropped vertices, fills arrays that only other files have.
    /// Throws Error if no point is left and the scan may not be empty.
    /// @param title name of the scan within the file; "" if the file is one scan
    void finishScan(const InputFile& input, const std::string& title = "", Emptiness emptiness = Emptiness::kRefused);

    /// Merges the frame of a file with that of the files before, as far as they agree. To be called once for each file.
    void setWorldFrame(const InputFile& input, const WorldFrame& frame);

    /// Counts a file whose x and y are degrees of longitude and latitude, and adds a note unless they will be scaled.
    void addDegrees(const InputFile& input);

    /// Sets the scanner position of the current scan, in its own frame; finishScan() transforms it.
    void setScanSensor(const std::optional<Vec3d>& in_scan) { scan_.sensor = in_scan; }
    /// Sets the scanner position of the scan finished last, in world coordinates; ignored if not finite.
    void setSensor(const Vec3d& world_position);
    /// Sets the scanner position of the scan finished last for a triangulation scanner that sweeps a sheet of light
    /// over the object in parallel and looks along -Z of the scan's frame, as in the Stanford 3D Scanning Repository.
    void setSensorAlongZ();

    /// For a file with fewer points than its header declares: throws Error, or adds a note if the sink salvages and
    /// there are any points.
    /// @param fault what is wrong, "truncated" or a reader's message
    void acceptShort(const InputFile& input, std::uint64_t found, std::uint64_t promised,
                     const std::string& fault = "truncated");

    /// Adds a note about the file.
    void note(const InputFile& input, const std::string& text);

    /// Reserves memory for several scans with the arrays of the current one, if the cloud keeps points.
    /// @param points total number of points that the cloud will have
    void reserve(std::size_t points);

    /// Whether the cloud keeps all points, rather than handing them on in batches.
    bool keepsPoints() const { return storage_->keepsPoints(); }
    /// As PointStorage::gatherScan: for range grids.
    bool gatherScan(std::uint64_t cells) { return storage_->gatherScan(cells); }
    bool holdsScan() const { return storage_->holdsScan(); }
    /// Points stored so far, of all scans, whether the cloud still holds them or not.
    std::uint64_t pointCount() const { return storage_->count(); }
    /// Vertices read so far of the current scan.
    std::uint64_t vertexCount() const { return scan_.vertices; }
    /// The box around the points of the scan finished last.
    ScanBox lastScanBox() const { return storage_->boxOf(scans.back()); }
    /// Points of all scans that were corners of a removed face, as indices into the cloud.
    const std::vector<std::uint32_t>& cornersOfRemovedFaces() const { return scan_.faces.cornersOfRemovedFaces(); }
    /// Findings of reading in batches so far. Requires a sink with batches.
    const BatchFindings& batchFindings() const { return batch_storage_->findings(); }

    Cloud& cloud;
    AttributeChoice attributes;
    std::optional<int> level; ///< see SinkOptions
    double skim;              ///< see SinkOptions
    bool scales_degrees;      ///< see SinkOptions
    bool gaussians_as_discs;  ///< see SinkOptions
    bool drops_withheld;      ///< see SinkOptions
    bool salvages;            ///< see SinkOptions
    ScanTransform transform;
    PointFilter filter;
    Columns columns;
    MeshPaint paint;                      ///< of the cloud's triangles
    GridBuilder grid;                     ///< of the current scan
    std::vector<ScanRange> scans;         ///< finished ones
    std::function<void(double)> progress; ///< receives the share of the current file that is read; may be empty
    std::size_t files_in_degrees = 0;     ///< files whose x and y are degrees
    std::size_t files_with_crs = 0;       ///< files that name their coordinate system
    std::uint64_t points_promised = 0; ///< number declared by the current file, if it holds fewer; reset for each file
    std::vector<ScanNoData> no_data;   ///< customary values of all finished scans
    /// The customary values that an earlier pass over the same files found: their points are left out.
    std::vector<ScanNoData> known_no_data;
    bool finds_no_data = true; ///< whether upcoming points may include points without data

private:
    void beginColumns(const InputFile& input, std::size_t length);
    void reserveArrays(std::size_t length);
    bool passesFilter(const Vec3d& position, std::uint8_t point_class);
    bool addPosition(const Vec3d& position);
    void reportProgress(std::uint64_t vertex) const;
    void requirePoints(const InputFile& input, std::size_t kept) const;
    std::uint8_t classOf(const char* values) const;
    bool dropsNoData(const Vec3d& in_scan, const Vec3d& position);
    bool mayLackData() const;
    void findNoReturns(const InputFile& input);
    void findNoData(const InputFile& input);
    void noteWithheld(const InputFile& input);

    std::unique_ptr<PointStorage> storage_;
    BatchStorage* batch_storage_ = nullptr; ///< storage_, if it is a BatchStorage
    CurrentScan scan_;
    std::optional<ColumnPlace> class_column_; ///< of the current scan
    std::optional<ColumnPlace> withheld_column_;
    NoDataSurvey survey_;          ///< of the current scan
    std::vector<NoData> dropped_;  ///< known_no_data of the current scan
    bool has_world_frame_ = false; ///< a file has set Cloud::world
};

} // namespace pointrt
