/* SPDX-License-Identifier: Apache-2.0 */
#include <pointrt/pro.h>
#include <stdio.h>

int main(int argc, char** argv) {
    pro_file* file;
    pro_message message;
    if (argc != 2 || pro_open(argv[1], 0, &file, &message) != PRO_OK) return 1;
    pro_close(file);
    return puts("opened") < 0;
}
