/* SPDX-License-Identifier: Apache-2.0 */
/* C interface to .pro files. Safe for untrusted files: a file that opens has passed all structural checks, so every
 * index reachable through a pro_view is in range. Functions neither throw nor keep global state. Several threads may
 * read one pro_file. */
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
    PRO_UNSUPPORTED = 3,  /* other major version, or an unknown section marked required */
    PRO_CANNOT_WRITE = 4, /* output folder missing, disk full, no permission */
    PRO_OUT_OF_MEMORY = 5,
    PRO_BAD_ARGUMENT = 6 /* error of the caller: null pointer, count out of range */
} pro_result;

/* One line of text without the file name, always terminated. */
typedef struct pro_message {
    uint32_t finding; /* stable number from SPEC.md, 0 if none applies */
    char text[252];
} pro_message;

/* The header, in the units noted. */
typedef struct pro_info {
    uint32_t version_major, version_minor;
    uint64_t file_bytes;
    uint32_t flags;     /* PRO_FLAG_* */
    uint32_t max_depth; /* 0 to PRO_MAX_DEPTH */
    uint32_t splat_count, node_count, leaf_count, ref_count, material_count;
    float radius_max;                    /* cube units */
    float radius_step;                   /* octaves per code */
    float blend_slab;                    /* relative to the radius */
    double origin[3];                    /* input units */
    double scale;                        /* input units per cube edge */
    double bounds_min[3], bounds_max[3]; /* input units */
} pro_info;

/* The sections, as pointers into the bytes of the file. order is NULL and metadata_bytes 0 if absent.
 * pro_view and pro_info do not grow within a major version, since a program may be older than the shared library. */
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

/* The tracing index, precomputed from the octree (words: pro_index_layout.h, rules: SPEC.md). All of its indices are in
 * range, but its completeness is not checked: it may lack discs that cross a cell. */
typedef struct pro_index {
    uint32_t shift;     /* log2 of a grid cell's edge in position steps */
    uint32_t origin[3]; /* lowest grid cell, in grid cells */
    uint32_t size[3];   /* in cells */
    uint32_t uneven;    /* 1: brick words may name groups; 0: no groups */
    uint32_t brick_count, group_count, cell_count;
    uint32_t near_count;         /* even */
    uint32_t blending_count;     /* even */
    const uint32_t* grid;        /* [size[2]][size[1]][size[0]] */
    const uint32_t* bricks;      /* [brick_count][64], then [group_count][8] */
    const uint32_t* cells;       /* [cell_count][4] */
    const uint32_t* slabs;       /* [cell_count] */
    const uint32_t* near_splats; /* [near_count][2] */
    const uint32_t* listed;      /* [near_count] */
    const uint32_t* blending;    /* [blending_count / 2]: two signed 16-bit numbers each */
} pro_index;

/* An extra per-point attribute besides position, normal and colour, stored bit for bit as in the input. */
typedef struct pro_attribute {
    char name[PRO_ATTRIBUTE_NAME_MAX + 1]; /* UTF-8, terminated, unique in a file; SPEC.md lists names with a meaning */
    uint32_t type;                         /* PRO_TYPE_* */
    uint32_t components;                   /* 1 to 4 */
    double low, high;                      /* range of the finite values; both 0 if no value is finite */
    const void* values;                    /* [splat_count][components] */
} pro_attribute;

/* The frame of a scan in the world, as far as it is known. */
typedef struct pro_world {
    float up[3];            /* unit length; zeros: unknown */
    double metres_per_unit; /* 0: unknown */
    uint32_t sensor_count;  /* scans in SENS, as numbered by the attribute "scan" */
    const double* sensors;  /* [sensor_count][4]: position in input coordinates and 1, or zeros; NULL without SENS */
} pro_world;

/* How the splats were made from the points of the input, as far as it is known. */
typedef struct pro_sampling {
    uint32_t input_count;  /* points in the input, as order numbers them; 0: unknown */
    uint32_t filled_count; /* splats that fill gaps between points: their order is input_count or above */
    float noise_median;    /* median of noise in input units, set by the writer; 0 without NOIS */
    const uint8_t* noise;  /* [splat_count]: standard deviation of the surface around a splat in steps of its
                              radius / PRO_NOISE_STEPS; NULL without NOIS: clean */
} pro_sampling;

/* An unpacked splat: cube units, unit normal, sRGB bytes. */
typedef struct pro_splat {
    float position[3];
    float normal[3];
    float radius;
    uint8_t color[3];
    uint8_t material;
} pro_splat;

/* A Gaussian, unpacked: a translucent volume. Cube units. */
typedef struct pro_gaussian {
    double mean[3];
    float deviation[3]; /* standard deviation along each of its own axes */
    float rotation[4];  /* unit quaternion w x y z: its own axes to those of the cube */
    float opacity;      /* at the mean, 0 to 1 */
    float color[3];     /* display-encoded (sRGB), not limited to 0 to 1; without the view-dependent part */
} pro_gaussian;

/* The exact parameters of a Gaussian whose rounded codes would visibly differ. Units as in pro_gaussian. */
typedef struct pro_exact_gaussian {
    uint32_t index; /* of the Gaussian */
    float rotation[4];
    float deviation[3];
    float opacity;
} pro_exact_gaussian;

/* The Gaussians of a file: their coding, and the sections. All indices are in range, and the octree has no cycles and
 * no node deeper than PRO_MAX_DEPTH. It is not checked that each Gaussian is listed in every node that it reaches. */
typedef struct pro_gaussians {
    uint32_t degree;                     /* of the view-dependent colour, 0 to 3 */
    float deviation_low, deviation_step; /* log2 of the smallest in cube units, and octaves per code */
    float color_low, color_step;         /* colour of code 0; step per code of red and green, half of blue's */
    float harmonic_max[3];               /* largest coefficient of degree 1, 2, 3; 0 above degree */
    const uint32_t* words;               /* [splat_count][4] */
    const int8_t* harmonics;             /* [splat_count][3 * pro_harmonic_count(degree)]; NULL if degree is 0 */
    uint32_t node_count, list_count;
    const uint32_t* nodes; /* [node_count][2] */
    const uint32_t* lists; /* [list_count] */
    uint32_t exact_count;
    const pro_exact_gaussian* exact; /* [exact_count], index increasing; NULL without GEXA */
} pro_gaussians;

typedef struct pro_file pro_file;

/* PRO_OPEN_SKIP_CHECKSUMS skips the XXH3 of sections, but not the structural checks.
 * PRO_OPEN_TRACE is for tracers: in a file with an index, NODE, LEAF, REFS, ORDR and META are neither checked nor read,
 * and their pointers in the view are NULL. */
enum { PRO_OPEN_SKIP_CHECKSUMS = 1, PRO_OPEN_TRACE = 2 };

/* Maps path read-only and validates it. On success *file is set and must be closed with pro_close, otherwise it is
 * NULL. message may be NULL. The file must not be modified or truncated while it is open. */
PRO_API pro_result pro_open(const char* path, uint32_t open_flags, pro_file** file, pro_message* message);

/* The same for bytes in memory, which must stay unchanged until pro_close; data must be 8-byte aligned. */
PRO_API pro_result pro_open_memory(const void* data, size_t bytes, uint32_t open_flags, pro_file** file,
                                   pro_message* message);
PRO_API void pro_close(pro_file* file);

PRO_API void pro_get_info(const pro_file* file, pro_info* info);
PRO_API void pro_get_view(const pro_file* file, pro_view* view);
/* Returns 1, or 0 and zeros in *index if the file has no index. */
PRO_API int pro_get_index(const pro_file* file, pro_index* index);
/* Returns 1, or 0 and zeros in *gaussians if the file has none. */
PRO_API int pro_get_gaussians(const pro_file* file, pro_gaussians* gaussians);
/* Unknown values are 0. */
PRO_API void pro_get_world(const pro_file* file, pro_world* world);
/* Unknown values are 0. */
PRO_API void pro_get_sampling(const pro_file* file, pro_sampling* sampling);
/* Number of attributes. With PRO_OPEN_TRACE their checksums are not compared. */
PRO_API uint32_t pro_attribute_count(const pro_file* file);
/* An attribute by its number in the file or by name. Returns 1, or 0 and zeros in *attribute if the file lacks it. */
PRO_API int pro_get_attribute(const pro_file* file, uint32_t number, pro_attribute* attribute);
PRO_API int pro_find_attribute(const pro_file* file, const char* name, pro_attribute* attribute);
/* Size in bytes of a PRO_TYPE_*; 0 for other numbers. */
PRO_API uint32_t pro_type_bytes(uint32_t type);
/* A value as a double; component c of a splat has the number splat * components + c. */
PRO_API double pro_attribute_value(const pro_attribute* attribute, size_t number);
/* All bytes of the file (page aligned after pro_open). */
PRO_API const void* pro_bytes(const pro_file* file, size_t* bytes);

/* Reports all findings, not only the first, including checks that safety does not need. Calls report (may be NULL) for
 * each and returns their number. A finding at many places of a section is reported once, with the first place and the
 * number of places. data must be 8-byte aligned. pro_verify returns PRO_OK if the file could be read, even with
 * findings. */
typedef void (*pro_report)(const pro_message* finding, void* user);
PRO_API size_t pro_verify_memory(const void* data, size_t bytes, pro_report report, void* user);
PRO_API pro_result pro_verify(const char* path, pro_report report, void* user, size_t* findings, pro_message* message);

/* Writes info and view as a .pro, atomically. Replaces an existing file, keeping its permissions, or the target of a
 * symbolic link. Leaves nothing behind on failure. Ignores version_* and file_bytes of info; order may be NULL and
 * metadata_bytes 0. Returns PRO_BAD_ARGUMENT, with the number of the finding in message, for content that pro_open
 * would refuse. The same content gives the same bytes. */
PRO_API pro_result pro_write(const char* path, const pro_info* info, const pro_view* view, pro_message* message);

/* The same with a tracing index, which may be NULL. */
PRO_API pro_result pro_write_indexed(const char* path, const pro_info* info, const pro_view* view,
                                     const pro_index* index, pro_message* message);

/* The same, but never replaces a file: returns PRO_CANNOT_WRITE if path exists or another process creates it
 * meanwhile. */
PRO_API pro_result pro_write_new(const char* path, const pro_info* info, const pro_view* view, const pro_index* index,
                                 pro_message* message);

/* The complete content of a file; zeros and NULLs for absent parts. */
typedef struct pro_content {
    const pro_info* info;
    const pro_view* view;
    const pro_index* index;
    const pro_world* world;
    const pro_attribute* attributes; /* low and high are set by the writer */
    uint32_t attribute_count;        /* at most PRO_ATTRIBUTE_MAX */
    const pro_sampling* sampling;
} pro_content;

/* Writes content like pro_write, or like pro_write_new if replace is 0. Writes nothing for sampling if there are
 * neither noise nor filled splats. */
PRO_API pro_result pro_write_content(const char* path, const pro_content* content, int replace, pro_message* message);

/* The same with the Gaussians of the splats, which may be NULL; harmonics are ignored if the degree is 0. */
PRO_API pro_result pro_write_gaussians(const char* path, const pro_content* content, const pro_gaussians* gaussians,
                                       int replace, pro_message* message);

/* Packs a splat. Positions must be in [0, 1). The radius is rounded up, which keeps surfaces closed. */
PRO_API void pro_splat_encode(const pro_splat* splat, float radius_max, float radius_step, uint32_t words[4]);
PRO_API void pro_splat_decode(const uint32_t words[4], float radius_max, float radius_step, pro_splat* splat);

/* Whether a packed splat is a ball: a sphere instead of a disc, with a normal that has no meaning. Only files with
 * PRO_FLAG_BALLS have any. */
PRO_API int pro_splat_is_ball(const uint32_t words[4]);
/* Turns a packed splat into a ball. */
PRO_API void pro_splat_set_ball(uint32_t words[4]);

/* Packs a Gaussian, clamping values to the range of the coding. splat: its SPLT words, of which only the position is
 * used; the mean must lie in the same position step. */
PRO_API void pro_gaussian_encode(const pro_gaussian* gaussian, const pro_gaussians* coding, const uint32_t splat[4],
                                 uint32_t words[4]);
/* Unpacks the codes alone; pro_gaussian_at also reads the exact parameters. */
PRO_API void pro_gaussian_decode(const pro_gaussians* coding, const uint32_t splat[4], const uint32_t words[4],
                                 pro_gaussian* gaussian);

/* The Gaussian of a splat as the file holds it. splats: SPLT; index: below splat_count. */
PRO_API void pro_gaussian_at(const pro_gaussians* gaussians, const uint32_t* splats, uint32_t index,
                             pro_gaussian* gaussian);

/* Spherical-harmonic coefficients per colour channel up to this degree, without the constant one: 0, 3, 8, 15; 0 for
 * other degrees. */
PRO_API uint32_t pro_harmonic_count(uint32_t degree);

/* A short description of a result. */
PRO_API const char* pro_result_name(pro_result result);

#ifdef __cplusplus
}
#endif

#endif
