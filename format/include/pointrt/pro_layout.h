/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The layout of a .pro file: every offset, shift and mask. Valid in C99, C++ and GLSL; format/SPEC.md explains the
 * fields.
 *
 *   byte 0        header, PRO_HEADER_BYTES long (section table at PRO_TABLE_OFFSET)
 *   byte 4096 k   sections, each starting on PRO_SECTION_ALIGNMENT:
 *                   NODE  uint32[node_count]      full octree, groups of 8, breadth first
 *                   LEAF  uint32[leaf_count][4]   members and references of each filled leaf
 *                   REFS  uint32[ref_count]       tentative splats of the leaves
 *                   SPLT  uint32[splat_count][4]  packed splats, in leaf order
 *                   MATL  float[material_count][16]
 *                   ORDR  uint32[splat_count]     input index of each splat
 *                   META  bytes                   UTF-8 JSON, provenance
 *                 and, all or none of them, the tracing index (pro_index_layout.h):
 *                   ENTR  uint32[]                entry grid, x fastest
 *                   BRKS  uint32[][8]             bricks of 64 words, then groups of 8
 *                   CELS  uint32[][4]             listed cells
 *                   SLBS  uint32[]                two planes around each listed cell's discs
 *                   DSCS  uint32[][4]             near splats, two to an element
 *                   DSPL  uint32[][2]             the splat of each near splat, two to an element
 *                   BLDS  int16[][2]              splats that only blend in each listed cell
 *                 and, all or none of them (GHRM if the degree is not 0), the Gaussians:
 *                   GAUS  uint32[splat_count][4]  the Gaussian of each splat
 *                   GHRM  int8[splat_count][]     view-dependent colour of each Gaussian
 *                   GNOD  uint32[][2]             octree of Gaussians, groups of 8, breadth first
 *                   GLST  uint32[]                Gaussians listed in its nodes
 *                   GEXA  bytes[][36]             optional: exact parameters of some Gaussians
 *                 and, all optional:
 *                   NOIS  uint8[splat_count]      noise of the surface around each splat
 *                   SENS  double[][4]             scanner position of each scan
 *                   ATTD  bytes[][64]             name, type and range of each attribute
 *                   ATTR  number[splat_count][]   the values of an attribute, one section per record
 *
 * All values are little-endian. Positions and lengths are in units of the cube edge ("cube units"):
 * input coordinate = origin + scale * cube coordinate, with origin and scale in double.
 */
#ifndef POINTRT_PRO_LAYOUT_H
#define POINTRT_PRO_LAYOUT_H

#define PRO_VERSION_MAJOR 1
#define PRO_VERSION_MINOR 5

/* 0x89 "PRO" CR LF 0x1A LF: not text, and damaged by transfers that treat it as text. */
#define PRO_MAGIC_WORD0 0x4F525089u
#define PRO_MAGIC_WORD1 0x0A1A0A0Du
#define PRO_HEADER_BYTES 4096
#define PRO_SECTION_ALIGNMENT 4096

/* Header fields: byte offsets. Unlisted bytes are reserved and 0. */
#define PRO_OFF_MAGIC 0           /* uint32[2], PRO_MAGIC_WORD0 and 1 */
#define PRO_OFF_VERSION_MAJOR 8   /* uint32 */
#define PRO_OFF_VERSION_MINOR 12  /* uint32 */
#define PRO_OFF_FILE_BYTES 16     /* uint64 */
#define PRO_OFF_HEADER_XXH3 24    /* uint64, XXH3-64 of bytes 32 to 4095 */
#define PRO_OFF_SECTION_COUNT 32  /* uint32 */
#define PRO_OFF_SECTION_STRIDE 36 /* uint32, PRO_SECTION_BYTES */
#define PRO_OFF_FLAGS 40          /* uint32, PRO_FLAG_* */
#define PRO_OFF_MAX_DEPTH 44      /* uint32, depth of the deepest leaf; the root has depth 0 */
#define PRO_OFF_SPLAT_COUNT 48    /* uint32 */
#define PRO_OFF_NODE_COUNT 52     /* uint32, a multiple of 8 */
#define PRO_OFF_LEAF_COUNT 56     /* uint32, filled leaves */
#define PRO_OFF_REF_COUNT 60      /* uint32 */
#define PRO_OFF_MATERIAL_COUNT 64 /* uint32, 1 to 256 */
#define PRO_OFF_RADIUS_MAX 68     /* float, cube units */
#define PRO_OFF_RADIUS_STEP 72    /* float, octaves per radius code */
#define PRO_OFF_BLEND_SLAB 76     /* float, half the height of a splat's blending slab, relative to its radius */
#define PRO_OFF_ORIGIN 80         /* double[3], input coordinates of the cube's lowest corner */
#define PRO_OFF_SCALE 104         /* double, cube edge in input units */
#define PRO_OFF_BOUNDS_MIN 112    /* double[3], splat centres, input coordinates */
#define PRO_OFF_BOUNDS_MAX 136    /* double[3] */
#define PRO_OFF_OLD_GRID                                                                                               \
    160                    /* 36 bytes, 0: files from before release 0.1.0 have an older index here and are refused    \
                            */
#define PRO_OFF_UP 196     /* float[3], up direction, unit length; 0: unknown */
#define PRO_OFF_METRES 208 /* double, metres per input unit; 0: unknown */
#define PRO_OFF_INPUT_COUNT 216  /* uint32, points in the input; 0: unknown */
#define PRO_OFF_FILLED_COUNT 220 /* uint32, splats that fill gaps between points */
#define PRO_OFF_NOISE 224        /* float, median of NOIS in input units; 0 without it */
#define PRO_OFF_GRID_SHIFT 228   /* uint32; this and the following fields are 0 without an index */
#define PRO_OFF_GRID_ORIGIN 232  /* uint32[3], lowest cell */
#define PRO_OFF_GRID_SIZE 244    /* uint32[3], cells */
#define PRO_OFF_GRID_UNEVEN 256  /* uint32, 0 or 1 */
#define PRO_OFF_BRICK_COUNT 260  /* uint32 */
#define PRO_GRID_FIELDS_END 264
#define PRO_OFF_HARMONICS_DEGREE 264 /* uint32, 0 to 3; this and the following fields are 0 without Gaussians */
#define PRO_OFF_DEVIATION_LOW 268    /* float, log2 of the smallest deviation, cube units */
#define PRO_OFF_DEVIATION_STEP 272   /* float, octaves per deviation code */
#define PRO_OFF_COLOR_LOW 276        /* float, colour of code 0 */
#define PRO_OFF_COLOR_STEP 280       /* float, step per code of red and green, half of blue's */
#define PRO_OFF_HARMONIC_MAX 284     /* float[3], largest coefficient of degree 1, 2 and 3; 0 above the degree */
#define PRO_FIELDS_END 296

#define PRO_FLAG_COLOR 1u    /* splat colours come from the input */
#define PRO_FLAG_ORIENTED 2u /* normals point outwards, as far as the bake can determine */
#define PRO_FLAG_PRUNED 4u   /* unnecessary references were dropped */
#define PRO_FLAG_BALLS 8u    /* splats may be balls (PRO_SPLAT_BALL) */
#define PRO_FLAGS_KNOWN 15u

/* Section table: PRO_OFF_SECTION_COUNT records of PRO_SECTION_BYTES. */
#define PRO_TABLE_OFFSET 512
#define PRO_SECTION_BYTES 64
#define PRO_SECTION_MAX 56
#define PRO_SEC_OFF_KIND 0    /* uint32, PRO_KIND_* */
#define PRO_SEC_OFF_STRIDE 4  /* uint32, bytes per element */
#define PRO_SEC_OFF_COUNT 8   /* uint64, elements */
#define PRO_SEC_OFF_OFFSET 16 /* uint64, from the start of the file */
#define PRO_SEC_OFF_LENGTH 24 /* uint64, bytes: stride * count */
#define PRO_SEC_OFF_XXH3 32   /* uint64, XXH3-64 of the section's bytes */
#define PRO_SEC_OFF_FLAGS 40  /* uint32, PRO_SECTION_REQUIRED or 0 */

#define PRO_SECTION_REQUIRED 1u /* readers that do not support the kind must refuse the file */

/* Four ASCII characters, the first in the lowest byte. */
#define PRO_KIND_NODE 0x45444F4Eu
#define PRO_KIND_LEAF 0x4641454Cu
#define PRO_KIND_REFS 0x53464552u
#define PRO_KIND_SPLT 0x544C5053u
#define PRO_KIND_MATL 0x4C54414Du
#define PRO_KIND_ORDR 0x5244524Fu
#define PRO_KIND_META 0x4154454Du
#define PRO_KIND_ENTR 0x52544E45u
#define PRO_KIND_BRKS 0x534B5242u
#define PRO_KIND_CELS 0x534C4543u
#define PRO_KIND_SLBS 0x53424C53u
#define PRO_KIND_DSCS 0x53435344u
#define PRO_KIND_DSPL 0x4C505344u
#define PRO_KIND_BLDS 0x53444C42u
#define PRO_KIND_GAUS 0x53554147u
#define PRO_KIND_GHRM 0x4D524847u
#define PRO_KIND_GNOD 0x444F4E47u
#define PRO_KIND_GLST 0x54534C47u
#define PRO_KIND_GEXA 0x41584547u
#define PRO_KIND_NOIS 0x53494F4Eu
#define PRO_KIND_SENS 0x534E4553u
#define PRO_KIND_ATTD 0x44545441u
#define PRO_KIND_ATTR 0x52545441u

/*
 * NODE: one word. 0 is an empty leaf; with PRO_NODE_INNER set the other bits are the number of the
 * group that holds the 8 children (words 8g to 8g+7); anything else is the leaf's index plus 1.
 * Group 0 holds the root in slot 0 and seven zeros, so that every group is 32-byte aligned.
 * The k-th inner node in array order (k from 0) names group k+1, so the tree cannot have cycles.
 * Slot of a child: bit 0 is its upper half in x, bit 1 in y, bit 2 in z.
 */
#define PRO_NODE_INNER 0x80000000u
#define PRO_NODE_GROUP_MASK 0x7FFFFFFFu
#define PRO_NODE_EMPTY 0u
#define PRO_GROUP_SIZE 8u

/*
 * LEAF: four words. Leaves are in Morton order of their cells; members are the splats
 * first_member .. +member_count, references the REFS words first_ref .. +ref_count, and both ranges
 * of a leaf follow those of the previous leaf.
 */
#define PRO_LEAF_WORDS 4u
#define PRO_LEAF_FIRST_MEMBER 0u
#define PRO_LEAF_FIRST_REF 1u
#define PRO_LEAF_COUNTS 2u /* members in the low half, references in the high half */
#define PRO_LEAF_RESERVED 3u
#define PRO_LEAF_MEMBER_MASK 0xFFFFu
#define PRO_LEAF_REF_SHIFT 16u
#define PRO_LEAF_LIST_MAX 0xFFFFu

/*
 * SPLT: four words.
 *   word 0  x[0..20] | y[0..10] << 21
 *   word 1  y[11..20] | z[0..20] << 10 | ball << 31
 *   word 2  octahedral normal u[0..11] | v[0..11] << 12 | material << 24
 *   word 3  red | green << 8 | blue << 16 | radius code << 24
 * position = (code + 0.5) / 2^21; radius = radius_max * 2^(-code * radius_step); colours are sRGB. A ball is a sphere
 * of that radius instead of a disc; its normal has no meaning.
 */
#define PRO_SPLAT_WORDS 4u
#define PRO_SPLAT_BALL 0x80000000u /* of word 1; 0 in files without PRO_FLAG_BALLS */
#define PRO_POSITION_BITS 21u
#define PRO_POSITION_MASK 0x1FFFFFu
#define PRO_POSITION_STEPS 2097152.0f          /* 2^21 */
#define PRO_POSITION_STEP 4.76837158203125e-7f /* 2^-21 */
#define PRO_Y_LOW_BITS 11u
#define PRO_Y_LOW_MASK 0x7FFu
#define PRO_Y_HIGH_BITS 10u
#define PRO_Y_HIGH_MASK 0x3FFu
#define PRO_NORMAL_BITS 12u
#define PRO_NORMAL_MASK 0xFFFu
#define PRO_NORMAL_STEPS 4095.0f
#define PRO_MATERIAL_SHIFT 24u
#define PRO_COLOR_MASK 0xFFFFFFu
#define PRO_RADIUS_SHIFT 24u
#define PRO_RADIUS_CODE_MAX 255u
#define PRO_RADIUS_MIN 8.67361737988403547e-19f /* 2^-60: no splat is smaller, so that its square is a normal float */

#define PRO_MAX_DEPTH PRO_POSITION_BITS

/* The entry grid's cells are cubes of the octree. */
#define PRO_GRID_SHIFT_MIN 7u            /* log2 of their edge in position steps: brick cells keep 32 or more */
#define PRO_GRID_WORDS_MAX 0x1000000u    /* 2^24: fits the texel buffers of all devices that the viewer supports */
#define PRO_INDEX_HALVINGS_MAX 12u       /* maximum number of groups above a cell */
#define PRO_INDEX_LISTED_MAX 0x7FFFFFFFu /* maximum number of near splats, and of blending numbers */

/* MATL: 16 floats per row, linear light. Unlisted floats are reserved and 0. */
#define PRO_MATERIAL_FLOATS 16u
#define PRO_MAT_BASE_COLOR 0u   /* 3 floats, multiplies the splat's colour */
#define PRO_MAT_REFLECTIVITY 3u /* 0 matte to 1 perfect mirror */
#define PRO_MAT_SPECULAR 4u     /* weight of the Phong highlight, 0 to 1 */
#define PRO_MAT_SHININESS 5u    /* Phong exponent, 1 to 1000 */

/*
 * GAUS: four words per splat, the Gaussian in its place. Its opacity at a point is `opacity` times exp(-d^2 / 2), where
 * d is the distance from its mean in standard deviations.
 *   word 0  rotation a | rotation b << 12 | largest component << 24 | residual x << 26
 *   word 1  rotation c | deviation of axis 0 << 12 | residual y << 24 | low 2 bits of opacity << 30
 *   word 2  deviation of axis 1 | deviation of axis 2 << 12 | high 8 bits of opacity << 24
 *   word 3  residual z | red << 6 | green << 15 | blue << 24
 * rotation: a unit quaternion w x y z whose largest component is positive and not stored; the others, in order, are
 *   (2 code / 4095 - 1) / sqrt(2)
 * deviation = 2^(deviation_low + code * deviation_step)
 * opacity = code / 1023
 * mean = (position code of SPLT + (residual + 0.5) / 64) / 2^21
 * colour = color_low + code * color_step, blue = color_low + 2 * code * color_step: sRGB, not limited to 0 to 1
 */
#define PRO_GAUSSIAN_WORDS 4u
#define PRO_ROTATION_BITS 12u
#define PRO_ROTATION_MASK 0xFFFu
#define PRO_ROTATION_STEPS 4095.0f
#define PRO_ROTATION_MAX 0.70710678118654752f /* sqrt(1/2): no component but the largest is above it */
#define PRO_ROTATION_LARGEST_SHIFT 24u        /* of word 0 */
#define PRO_ROTATION_LARGEST_MASK 3u
#define PRO_RESIDUAL_MASK 63u
#define PRO_RESIDUAL_STEPS 64.0f
#define PRO_RESIDUAL_X_SHIFT 26u  /* of word 0 */
#define PRO_RESIDUAL_Y_SHIFT 24u  /* of word 1; z is at 0 of word 3 */
#define PRO_DEVIATION_MASK 0xFFFu /* axis 1 is at 0 of word 2 */
#define PRO_DEVIATION_SHIFT 12u   /* axis 0 in word 1, axis 2 in word 2 */
#define PRO_DEVIATION_CODE_MAX 4095u
#define PRO_DEVIATION_LOG2_MIN (-60.0f) /* of deviation_low, so that squares are normal floats */
#define PRO_DEVIATION_LOG2_MAX 60.0f    /* of the largest code's deviation, so that squares are finite */
#define PRO_DEVIATION_LOW_MAX 10.0f     /* of deviation_low */
#define PRO_OPACITY_LOW_SHIFT 30u       /* of word 1 */
#define PRO_OPACITY_LOW_BITS 2u
#define PRO_OPACITY_LOW_MASK 3u
#define PRO_OPACITY_HIGH_SHIFT 24u /* of word 2 */
#define PRO_OPACITY_STEPS 1023.0f
#define PRO_GAUSSIAN_RED_SHIFT 6u /* of word 3, as are green and blue */
#define PRO_GAUSSIAN_GREEN_SHIFT 15u
#define PRO_GAUSSIAN_BLUE_SHIFT 24u
#define PRO_GAUSSIAN_COLOR_MASK 0x1FFu
#define PRO_GAUSSIAN_BLUE_MASK 0xFFu
#define PRO_GAUSSIAN_OPACITY_MIN (1.0f / 255.0f) /* a ray skips Gaussians whose opacity along it stays below */

/*
 * GHRM: signed bytes, red, green and blue of coefficient 1, then of coefficient 2 and so on, of degree 1 to the file's.
 * value = code / 127 * harmonic_max[degree of the coefficient - 1].
 */
#define PRO_HARMONICS_DEGREE_MAX 3u
#define PRO_HARMONIC_STEPS 127.0f
#define PRO_HARMONIC_INVALID (-128)

/*
 * GNOD: two words per node. Groups, their order and slots are those of NODE. Word 0 is the number of the group of the
 * node's children, or 0: the k-th node that has children (k from 0) names group k+1. Word 1 is the node's first entry
 * in GLST; its list ends where that of the next node starts, that of the last node at the end of GLST.
 */
#define PRO_GAUSSIAN_NODE_WORDS 2u
#define PRO_GAUSSIAN_NODE_CHILDREN 0u
#define PRO_GAUSSIAN_NODE_FIRST 1u
#define PRO_GAUSSIAN_LISTED_MAX 0x7FFFFFFFu /* maximum number of nodes, and of entries of GLST */

/*
 * GEXA: nine words per record, in increasing order of the Gaussian. They replace the rounded values of GAUS.
 *   word 0     Gaussian
 *   words 1-4  float, rotation w x y z: of unit length
 *   words 5-7  float, deviation of axes 0 to 2
 *   word 8     float, opacity, 0 to 1
 */
#define PRO_EXACT_GAUSSIAN_BYTES 36u

/* NOIS: one byte per splat, the standard deviation of the surface around it, in 1/32 of its radius. */
#define PRO_NOISE_STEPS 32.0f
#define PRO_NOISE_CODE_MAX 255u

/* SENS: four doubles per scan: the scanner's position in input coordinates and 1; zeros: unknown. */
#define PRO_SENSOR_DOUBLES 4u

/* ATTD: one record per attribute; the k-th ATTR section in the table has the values of the k-th attribute. */
#define PRO_ATTRIBUTE_BYTES 64u
#define PRO_ATTRIBUTE_MAX 32u
#define PRO_ATTRIBUTE_NAME_MAX 31u
#define PRO_ATTR_OFF_NAME 0        /* UTF-8, padded with zeros to 32 bytes */
#define PRO_ATTR_OFF_TYPE 32       /* uint32, PRO_TYPE_* */
#define PRO_ATTR_OFF_COMPONENTS 36 /* uint32, numbers per splat, 1 to 4 */
#define PRO_ATTR_OFF_RESERVED 40   /* 8 bytes, 0 */
#define PRO_ATTR_OFF_LOW 48        /* double, the smallest finite value of all components; 0 if no value is finite */
#define PRO_ATTR_OFF_HIGH 56       /* double, the largest, likewise */
#define PRO_ATTRIBUTE_COMPONENTS_MAX 4u

#define PRO_TYPE_I8 1u
#define PRO_TYPE_U8 2u
#define PRO_TYPE_I16 3u
#define PRO_TYPE_U16 4u
#define PRO_TYPE_I32 5u
#define PRO_TYPE_U32 6u
#define PRO_TYPE_I64 7u
#define PRO_TYPE_U64 8u
#define PRO_TYPE_F32 9u
#define PRO_TYPE_F64 10u

#endif
