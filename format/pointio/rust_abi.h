/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the Rust half of this library (src/) gives to the C++ half: the compression of LAZ files, and E57 files.
 * There without Rust too, but then nothing defines it: POINTRT_LAZ_E57 is 0.
 *
 * Functions that take a scan_error return false, or NULL, when they fail, and have told why in it: bytes that
 * come from a file may be anything, they never crash or read out of bounds. Other arguments are the caller's to get
 * right. Nothing is kept between calls but what a handle holds; a handle is used by one thread at a time.
 */
#ifndef POINTRT_SCANFILE_ABI_H
#define POINTRT_SCANFILE_ABI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A few words without the file's name, ended by a 0. */
typedef struct scan_error {
    char text[256];
} scan_error;

/* Takes the next bytes; false where it cannot. Must not throw. */
typedef bool (*scan_write)(void* user, const uint8_t* data, size_t bytes);

/* ---- LAZ: vlr is the payload of the file's LASzip VLR, a record is a point as in a LAS file. ---- */

typedef struct scan_laz_reader scan_laz_reader;

/* Starts with the first point of a chunk, or of all data where the file has no chunks. chunk: as long as the reader
 * lives. Fails when records of the VLR are not record_bytes long. */
scan_laz_reader* scan_laz_open(const uint8_t* vlr, size_t vlr_bytes, size_t record_bytes, const uint8_t* chunk,
                               size_t chunk_bytes, scan_error* error);
/* The next records, as many as fit into bytes. After a failure only close may follow. */
bool scan_laz_read(scan_laz_reader* reader, uint8_t* records, size_t bytes, scan_error* error);
/* Bytes of the chunk that were read so far; once all of its points are, those of the chunk. */
uint64_t scan_laz_consumed(const scan_laz_reader* reader);
void scan_laz_close(scan_laz_reader* reader); /* NULL is nothing */

/* Of a chunk table, its version and number of chunks included: points (has_counts, else 0) and bytes of each chunk.
 * chunks: what the table says, which the caller has held against the file's length. */
bool scan_laz_read_table(const uint8_t* table, size_t table_bytes, bool has_counts, size_t chunks, uint64_t* counts,
                         uint64_t* sizes, scan_error* error);

/* A VLR's payload for point format 0 to 10, in chunks of chunk_points each. */
bool scan_laz_describe(uint8_t point_format, uint16_t extra_bytes, uint32_t chunk_points, scan_write write, void* user,
                       scan_error* error);
/* Packs one chunk. */
bool scan_laz_pack(const uint8_t* vlr, size_t vlr_bytes, const uint8_t* records, size_t bytes, scan_write write,
                   void* user, scan_error* error);
/* The chunk table, from points (written where they vary) and bytes of each chunk. */
bool scan_laz_pack_table(const uint8_t* vlr, size_t vlr_bytes, const uint64_t* counts, const uint64_t* sizes,
                         size_t chunks, scan_write write, void* user, scan_error* error);

/* ---- E57 ---- */

typedef struct scan_e57 scan_e57;
typedef struct scan_e57_points scan_e57_points;

/* What a column holds: raw whole numbers of which the value is the number itself, or offset + scale * number; or
 * reals. */
enum { SCAN_E57_WHOLE = 0, SCAN_E57_SCALED = 1, SCAN_E57_SINGLE = 2, SCAN_E57_DOUBLE = 3 };

typedef struct scan_e57_column {
    const char* name; /* as in the standard, "cartesianX"; "PREFIX:NAME", or "NAME", of an extension */
    uint32_t kind;
    int64_t least, most; /* raw whole numbers, which are held to them; all of 64 bits where the file says nothing */
    double scale, offset;
} scan_e57_column;

typedef struct scan_e57_limits {
    bool are_there;
    double least, most;
} scan_e57_limits;

typedef struct scan_e57_scan {
    const char* name;
    const char* guid;
    uint64_t points; /* as promised; those of all scans together fit in the file's bytes */
    const scan_e57_column* columns;
    size_t column_count;
    bool has_pose;
    double rotation[4];    /* w x y z; as in the file, of any length: file = rotation * scan + translation */
    double translation[3]; /* metres */
    scan_e57_limits color_limits[3], intensity_limits; /* the scan's, or else those of the column's type */
} scan_e57_scan;

/* Reads what a file says of its scans. bytes: all of the file, as long as what is opened of it lives. */
scan_e57* scan_e57_open(const uint8_t* bytes, size_t size, scan_error* error);
void scan_e57_close(scan_e57* file); /* NULL is nothing */
size_t scan_e57_scans(const scan_e57* file);
size_t scan_e57_images(const scan_e57* file);
/* Well-known text of a coordinate system, as it should be; "" where there is none. */
const char* scan_e57_coordinate_metadata(const scan_e57* file);
/* What it points to lives as long as the file. scan: below scan_e57_scans. */
scan_e57_scan scan_e57_describe(const scan_e57* file, size_t scan);

/* Starts with a scan's first point. It may outlive the file, but not its bytes. */
scan_e57_points* scan_e57_begin(const scan_e57* file, size_t scan, scan_error* error);
/* Reads the next points, capacity at most: column i to columns[i], an array of int64_t, float or double by its kind, or
 * NULL where it is not wanted. count: how many; 0 after the last. Checksums of all pages read are checked. After a
 * failure only end may follow. */
bool scan_e57_read(scan_e57_points* points, size_t capacity, void* const* columns, size_t* count, scan_error* error);
/* Where in the file it reads on. */
uint64_t scan_e57_position(const scan_e57_points* points);
void scan_e57_end(scan_e57_points* points); /* NULL is nothing */

#ifdef __cplusplus
}
#endif

#endif
