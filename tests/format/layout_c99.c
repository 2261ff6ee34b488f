/* SPDX-License-Identifier: Apache-2.0 */
/* The public headers are C99; compiled and called from C. */
#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

typedef char kinds_are_characters[PRO_KIND_NODE == ('N' | 'O' << 8 | 'D' << 16 | (unsigned)'E' << 24) ? 1 : -1];
typedef char table_fits_header[PRO_TABLE_OFFSET + PRO_SECTION_MAX * PRO_SECTION_BYTES == PRO_HEADER_BYTES ? 1 : -1];
typedef char fields_end_before_table[PRO_FIELDS_END <= PRO_TABLE_OFFSET ? 1 : -1];

#define KIND(a, b, c, d) (a | b << 8 | c << 16 | (unsigned)d << 24)
typedef char gaussian_kinds_are_characters
    [PRO_KIND_GAUS == KIND('G', 'A', 'U', 'S') && PRO_KIND_GHRM == KIND('G', 'H', 'R', 'M') ? 1 : -1];
typedef char gaussian_tree_kinds_are_characters
    [PRO_KIND_GNOD == KIND('G', 'N', 'O', 'D') && PRO_KIND_GLST == KIND('G', 'L', 'S', 'T') ? 1 : -1];

/* Splats in the file at path, 0 when it does not open. */
uint32_t splatsFromC(const char* path) {
    pro_file* file = NULL;
    pro_message message;
    pro_info info;
    if (pro_open(path, 0, &file, &message) != PRO_OK) return 0;
    pro_get_info(file, &info);
    pro_close(file);
    return info.splat_count;
}
