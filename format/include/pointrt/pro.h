/* SPDX-License-Identifier: Apache-2.0 */
/* C interface to .pro files. Safe for untrusted files: a file that opens has passed every structural
 * check, so all indices reachable through a pro_view are in range. Nothing here throws or keeps global state;
 * a pro_file may be read from several threads. */
#ifndef POINTRT_PRO_H
#define POINTRT_PRO_H

#include <stddef.h>
#include <stdint.h>

#include "pointrt/pro_layout.h"

#if defined(__GNUC__)
#define PRO_API __attribute__((visibility("default")))
#else
#define PRO_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum pro_result {
    PRO_OK = 0,
    PRO_CANNOT_READ = 1,  /* missing, no permission, not a regular file, empty */
    PRO_INVALID = 2,      /* a structural or checksum finding; message has its number */
    PRO_UNSUPPORTED = 3,  /* newer major version, or an unknown section marked required */
    PRO_CANNOT_WRITE = 4, /* output folder missing, disk full, no permission */
    PRO_OUT_OF_MEMORY = 5,
    PRO_BAD_ARGUMENT = 6 /* a caller's bug: null pointer, count out of range */
} pro_result;

/* One line for people, without the file's name; always terminated. */
typedef struct pro_message {
    uint32_t finding; /* stable number from SPEC.md, 0 where none applies */
    char text[252];
} pro_message;

/* What the header says, in input units where marked. */
typedef struct pro_info {
    uint32_t version_major, version_minor;
    uint64_t file_bytes;
    uint32_t flags;     /* PRO_FLAG_* */
    uint32_t max_depth; /* 0 to PRO_MAX_DEPTH */
    uint32_t splat_count, node_count, leaf_count, ref_count, material_count;
    float radius_max;                    /* cube units */
    float radius_step;                   /* octaves per code */
    float blend_slab;                    /* over the radius */
    double origin[3];                    /* input units */
    double scale;                        /* input units per cube edge */
    double bounds_min[3], bounds_max[3]; /* input units */
} pro_info;

/* The sections, pointing into the file's bytes. order is NULL and metadata_bytes 0 where absent.
 * Neither this nor pro_info grows within a major version: programs may be older than a shared library. */
typedef struct pro_view {
    const uint32_t* nodes;  /* [node_count] */
    const uint32_t* leaves; /* [leaf_count][4] */
    const uint32_t* refs;   /* [ref_count] */
    const uint32_t* splats; /* [splat_count][4] */
    const float* materials; /* [material_count][16] */
    const uint32_t* order;  /* [splat_count] or NULL */
    const char* metadata;   /* JSON, not terminated */
    uint64_t metadata_bytes;
} pro_view;

/* The tracing index, made of the octree once so that a tracer need not (words: pro_index_layout.h, rules: SPEC.md).
 * All of its indices are in range; whether it lists every disc that crosses a cell is up to who made it. */
typedef struct pro_index {
    uint32_t shift;     /* log2 of a grid cell's edge in position steps */
    uint32_t origin[3]; /* of the lowest grid cell, in grid cells */
    uint32_t size[3];   /* of the grid, in cells */
    uint32_t uneven;    /* 1: brick words may name groups; 0: there are none */
    uint32_t brick_count, group_count, cell_count;
    uint32_t near_count;         /* even */
    uint32_t blending_count;     /* even */
    const uint32_t* grid;        /* [size[2]][size[1]][size[0]] */
    const uint32_t* bricks;      /* [brick_count][64], behind them [group_count][8] */
    const uint32_t* cells;       /* [cell_count][4] */
    const uint32_t* slabs;       /* [cell_count] */
    const uint32_t* near_splats; /* [near_count][2] */
    const uint32_t* listed;      /* [near_count] */
    const uint32_t* blending;    /* [blending_count / 2]: two signed numbers of 16 bits each */
} pro_index;

/* What a scan says of each point besides position, normal and colour: numbers as the file had them, to the bit. */
typedef struct pro_attribute {
    char name[PRO_ATTRIBUTE_NAME_MAX +
              1];        /* UTF-8, terminated, unique in a file; SPEC.md has those that mean something */
    uint32_t type;       /* PRO_TYPE_* */
    uint32_t components; /* 1 to 4 */
    double low, high;    /* of all finite values; both 0 where there is none */
    const void* values;  /* [splat_count][components] */
} pro_attribute;

/* How a scan lies in the world, as far as is known. */
typedef struct pro_world {
    float up[3];            /* unit length, or zeros: not known */
    double metres_per_unit; /* 0: not known */
    uint32_t sensor_count;  /* of SENS: scans, numbered as the attribute "scan" does where there are several */
    const double* sensors;  /* [sensor_count][4]: position in input coordinates and 1, or zeros; NULL without SENS */
} pro_world;

/* How the splats came of the input's points, as far as is known. */
typedef struct pro_sampling {
    uint32_t input_count;  /* points of the input, as order numbers them; 0: not known */
    uint32_t filled_count; /* splats that fill gaps between points: their order is input_count or above */
    float noise_median;    /* of noise, input units, found by the writer; 0 without NOIS */
    const uint8_t* noise;  /* [splat_count]: standard deviation of the surface around a splat, in steps of 1 /
                              PRO_NOISE_STEPS of its radius; NULL without NOIS: clean */
} pro_sampling;

/* A splat in plain numbers: cube units, unit normal, sRGB bytes. */
typedef struct pro_splat {
    float position[3];
    float normal[3];
    float radius;
    uint8_t color[3];
    uint8_t material;
} pro_splat;

typedef struct pro_file pro_file;

/* PRO_OPEN_SKIP_CHECKSUMS leaves the sections' XXH3 out; the structure is checked all the same.
 * PRO_OPEN_TRACE is for tracers: of a file with an index, NODE, LEAF, REFS, ORDR and META are neither checked nor read,
 * and their pointers in the view are NULL. */
enum { PRO_OPEN_SKIP_CHECKSUMS = 1, PRO_OPEN_TRACE = 2 };

/* Maps path read-only and validates it. On success *file is set and must be closed with pro_close; otherwise it is
 * NULL. message may be NULL. The file must not be written in place or cut short while it is open. */
PRO_API pro_result pro_open(const char* path, uint32_t open_flags, pro_file** file, pro_message* message);

/* The same over bytes the caller keeps alive and unchanged until pro_close; data must be 8-byte aligned. */
PRO_API pro_result pro_open_memory(const void* data, size_t bytes, uint32_t open_flags, pro_file** file,
                                   pro_message* message);
PRO_API void pro_close(pro_file* file);

PRO_API void pro_get_info(const pro_file* file, pro_info* info);
PRO_API void pro_get_view(const pro_file* file, pro_view* view);
/* Returns 1, or 0 and zeros where the file has no index. */
PRO_API int pro_get_index(const pro_file* file, pro_index* index);
/* What is not known is 0 in it, and all of it in files before 1.2. */
PRO_API void pro_get_world(const pro_file* file, pro_world* world);
/* What is not known is 0 in it, and all of it in files before 1.3. */
PRO_API void pro_get_sampling(const pro_file* file, pro_sampling* sampling);
/* Attributes, in the file's order; 0 of them before 1.2. With PRO_OPEN_TRACE their checksums are not compared. */
PRO_API uint32_t pro_attribute_count(const pro_file* file);
/* Returns 1, or 0 and zeros where there is no such attribute. */
PRO_API int pro_get_attribute(const pro_file* file, uint32_t number, pro_attribute* attribute);
PRO_API int pro_find_attribute(const pro_file* file, const char* name, pro_attribute* attribute);
/* Bytes of a number of a type; 0 for what is no type. */
PRO_API uint32_t pro_type_bytes(uint32_t type);
/* One number of it as a double: component c of a splat is number splat * components + c. */
PRO_API double pro_attribute_value(const pro_attribute* attribute, size_t number);
/* The whole file as mapped (page aligned when it came from pro_open). */
PRO_API const void* pro_bytes(const pro_file* file, size_t* bytes);

/* Every finding in the bytes, not only the first, with checks that safety does not need; calls report (may be NULL) for
 * each and returns how many. A finding met at many places of a section is reported once, with the first and their
 * number. data must be 8-byte aligned. pro_verify returns PRO_OK when the file could be read, findings or not. */
typedef void (*pro_report)(const pro_message* finding, void* user);
PRO_API size_t pro_verify_memory(const void* data, size_t bytes, pro_report report, void* user);
PRO_API pro_result pro_verify(const char* path, pro_report report, void* user, size_t* findings, pro_message* message);

/* Writes info and view as a .pro that appears whole under its name, replacing what is there and keeping that one's
 * permissions; where path is a symbolic link, behind the link. Nothing is left behind on failure.
 * version_* and file_bytes of info are ignored; order may be NULL, metadata_bytes 0. The content passes the checks of
 * pro_open first: what it would refuse is PRO_BAD_ARGUMENT here, and the message has the finding's number.
 * The same content gives the same bytes. */
PRO_API pro_result pro_write(const char* path, const pro_info* info, const pro_view* view, pro_message* message);

/* The same with a tracing index, which makes the file version 1.4; NULL is pro_write. */
PRO_API pro_result pro_write_indexed(const char* path, const pro_info* info, const pro_view* view,
                                     const pro_index* index, pro_message* message);

/* The same, but never replaces: a file that has the name already, or gets it from somebody else meanwhile, stays, and
 * this one is PRO_CANNOT_WRITE. */
PRO_API pro_result pro_write_new(const char* path, const pro_info* info, const pro_view* view, const pro_index* index,
                                 pro_message* message);

/* Everything that a file can hold. Zeros, and NULLs, for what is not there. */
typedef struct pro_content {
    const pro_info* info;
    const pro_view* view;
    const pro_index* index;
    const pro_world* world;
    const pro_attribute* attributes; /* low and high are found by the writer */
    uint32_t attribute_count;        /* at most PRO_ATTRIBUTE_MAX */
    const pro_sampling* sampling;
} pro_content;

/* The same with what a scan says beside its points, which makes a file without an index version 1.2, and with noise or
 * filled splats, which make it version 1.3; without either of them nothing of sampling is written. replace: 0 is as
 * pro_write_new. */
PRO_API pro_result pro_write_content(const char* path, const pro_content* content, int replace, pro_message* message);

/* Packs splat; the radius is rounded up so that surfaces stay closed, positions must lie in [0,1). */
PRO_API void pro_splat_encode(const pro_splat* splat, float radius_max, float radius_step, uint32_t words[4]);
PRO_API void pro_splat_decode(const uint32_t words[4], float radius_max, float radius_step, pro_splat* splat);

/* What a result means in a few words. */
PRO_API const char* pro_result_name(pro_result result);

#ifdef __cplusplus
}
#endif

#endif
