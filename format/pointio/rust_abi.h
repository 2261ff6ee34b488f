/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The interface of the Rust half of this library (rust/): LAZ compression and E57 files. In builds without Rust
 * (POINTRT_LAZ_E57 is 0) nothing defines it.
 *
 * Functions with a scan_error return false or NULL on failure and write the reason to it. Bytes of files may be
 * hostile: they never cause crashes or reads out of bounds. Other arguments must be valid. There is no state between
 * calls except in handles; use a handle in one thread at a time.
 */
#ifndef POINTRT_SCANFILE_ABI_H
#define POINTRT_SCANFILE_ABI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A zero-terminated reason without the file's name. */
typedef struct scan_error {
    char text[256];
} scan_error;

/* Receives the next bytes; returns false on failure. Must not throw. */
typedef bool (*scan_write)(void* user, const uint8_t* data, size_t bytes);

/* ---- LAZ: vlr is the payload of the LASzip VLR, a record is a point as in a LAS file. ---- */

typedef struct scan_laz_reader scan_laz_reader;

/* Starts at the first point of a chunk, or of all data in files without chunks. chunk must outlive the reader. Fails if
 * records of the VLR are not record_bytes long. */
scan_laz_reader* scan_laz_open(const uint8_t* vlr, size_t vlr_bytes, size_t record_bytes, const uint8_t* chunk,
                               size_t chunk_bytes, scan_error* error);
/* Reads as many records as fit into bytes. After a failure only close may follow. */
bool scan_laz_read(scan_laz_reader* reader, uint8_t* records, size_t bytes, scan_error* error);
/* Bytes of the chunk read so far; after its last point the size of the chunk. */
uint64_t scan_laz_consumed(const scan_laz_reader* reader);
void scan_laz_close(scan_laz_reader* reader); /* accepts NULL */

/* Reads points (0 without has_counts) and bytes of each chunk from a chunk table, which includes version and number of
 * chunks. chunks: as stated in the table, which the caller has checked against the file size. */
bool scan_laz_read_table(const uint8_t* table, size_t table_bytes, bool has_counts, size_t chunks, uint64_t* counts,
                         uint64_t* sizes, scan_error* error);

/* Writes the payload of a VLR for point format 0 to 10 and chunks of chunk_points. */
bool scan_laz_describe(uint8_t point_format, uint16_t extra_bytes, uint32_t chunk_points, scan_write write, void* user,
                       scan_error* error);
/* Compresses one chunk. */
bool scan_laz_pack(const uint8_t* vlr, size_t vlr_bytes, const uint8_t* records, size_t bytes, scan_write write,
                   void* user, scan_error* error);
/* Writes the chunk table from points (stored if variable) and bytes of each chunk. */
bool scan_laz_pack_table(const uint8_t* vlr, size_t vlr_bytes, const uint64_t* counts, const uint64_t* sizes,
                         size_t chunks, scan_write write, void* user, scan_error* error);

/* ---- E57 ---- */

typedef struct scan_e57 scan_e57;
typedef struct scan_e57_points scan_e57_points;

/* The numbers of a column: integers, integers with value = offset + scale * integer, float or double. */
enum { SCAN_E57_WHOLE = 0, SCAN_E57_SCALED = 1, SCAN_E57_SINGLE = 2, SCAN_E57_DOUBLE = 3 };

typedef struct scan_e57_column {
    const char* name; /* as in the standard, "cartesianX"; "PREFIX:NAME", or "NAME", of an extension */
    uint32_t kind;
    int64_t least, most; /* limits of raw integers, which are checked; the range of 64 bits if not given */
    double scale, offset;
} scan_e57_column;

typedef struct scan_e57_limits {
    bool are_there;
    double least, most;
} scan_e57_limits;

typedef struct scan_e57_scan {
    const char* name;
    const char* guid;
    uint64_t points; /* as stated; all scans together fit in the file's bytes */
    const scan_e57_column* columns;
    size_t column_count;
    bool has_pose;
    double rotation[4];    /* w x y z; as in the file, of any length: file = rotation * scan + translation */
    double translation[3]; /* metres */
    scan_e57_limits color_limits[3], intensity_limits; /* of the scan, else of the column's type */
} scan_e57_scan;

/* Reads the descriptions of all scans. bytes: the file, which must outlive everything opened from it. */
scan_e57* scan_e57_open(const uint8_t* bytes, size_t size, scan_error* error);
void scan_e57_close(scan_e57* file); /* accepts NULL */
size_t scan_e57_scans(const scan_e57* file);
size_t scan_e57_images(const scan_e57* file);
/* WKT of a coordinate system by the standard, unchecked; or "". */
const char* scan_e57_coordinate_metadata(const scan_e57* file);
/* Pointers in the result are valid as long as the file. scan: below scan_e57_scans. */
scan_e57_scan scan_e57_describe(const scan_e57* file, size_t scan);

/* Starts at the first point of a scan. It may outlive the file, but not its bytes. */
scan_e57_points* scan_e57_begin(const scan_e57* file, size_t scan, scan_error* error);
/* Reads up to capacity points: column i into columns[i], an array of int64_t, float or double by its kind, or NULL to
 * skip it. count: points read; 0 after the last. Checks the checksum of every page. After a failure only end may
 * follow. */
bool scan_e57_read(scan_e57_points* points, size_t capacity, void* const* columns, size_t* count, scan_error* error);
/* The byte of the file that is read next. */
uint64_t scan_e57_position(const scan_e57_points* points);
void scan_e57_end(scan_e57_points* points); /* accepts NULL */

#ifdef __cplusplus
}
#endif

#endif
