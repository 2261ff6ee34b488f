// SPDX-License-Identifier: Apache-2.0
// bcryptprimitives.dll with the one function that Rust's library calls. Windows has it; Wine has it since version 9.
#include <windows.h>

#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(unsigned char* to, size_t bytes) {
    return RtlGenRandom(to, (ULONG)bytes);
}
