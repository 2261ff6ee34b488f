/* SPDX-License-Identifier: Apache-2.0 */
/* Reads a .pro and writes it anew: copy IN.pro OUT.pro */
#include <pointrt/pro.h>
#include <stdio.h>

static int fail(const char* path, const pro_message* message) {
    fprintf(stderr, "%s: %s\n", path, message->text);
    return 1;
}

int main(int argc, char** argv) {
    pro_file* file;
    pro_message message;
    pro_info info;
    pro_view view;
    size_t findings = 0;
    if (argc != 3) return 2;
    if (pro_verify(argv[1], NULL, NULL, &findings, &message) != PRO_OK || findings > 0) return fail(argv[1], &message);
    if (pro_open(argv[1], 0, &file, &message) != PRO_OK) return fail(argv[1], &message);
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    if (pro_write(argv[2], &info, &view, &message) != PRO_OK) return fail(argv[2], &message);
    if (pro_write(argv[2], &info, &view, &message) != PRO_OK) return fail(argv[2], &message); /* over the first */
    if (pro_write_new(argv[2], &info, &view, NULL, &message) != PRO_CANNOT_WRITE) return fail(argv[2], &message);
    pro_close(file);
    return 0;
}
