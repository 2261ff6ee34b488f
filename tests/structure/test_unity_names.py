#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""unity_names.py finds the names that clash in a batch, and no others."""
import typing
import unittest

import unity_names

# Pairs of declarations in anonymous namespaces of two sources.
CLASHES = {
    "functions": ("int f(int a) { return a; }", "double f(int b) { return {b}; }"),
    "default values": ("void f(const A& a, B b = {1, 2}) {}", "void f(const A& c, const B d) {}"),
    "unnamed parameters": ("void f(const std::string&) {}", "void f(const std::string& text) { if (text == \"}\") g(); }"),
    "function templates": ("template <typename A> void f(std::span<const A> a) {}",
                           "template <typename B> void f(std::span<const B> b) {}"),
    "operators": ("bool operator==(const A& a, const A& b) { return true; }",
                  "bool operator==(const A& c, const A& d) { return false; }"),
    "constants": ("constexpr int kA = 1;", "const std::vector<A> kA = {{1}, {2}};"),
    "several constants": ("constexpr double kA = f(1, 2), kB = 2;", "constexpr std::array<int, 2> kC{1, 2}, kB{3, 4};"),
    "constructed": ("const A kA(1, 2);", "const A kA(3, 4);"),
    "lambdas": ("const auto f = [](int a) { return a; };", "const auto f = [](int b) { return b; };"),
    "types": ("struct A { int a; };", "class A : public B { int a() { return 1; } };"),
    "a type and a constant": ("enum class A { kB };", "constexpr int A = 1;"),
    "enumerators": ("enum A { kA, kB = 2 };", "enum C { kD, kB };"),
    "aliases": ("using A = B;", "using A = C;"),
    "after a constructor": ("A::A() : a{1}, b{2} {}\nint f() { return 1; }", "int f() { return 2; }"),
    "after a condition": ("const A kA = b ? A{1} : A{2};\nint kB = 1;", "int kB = 2;"),
}
OTHERS = {
    "overloads": ("int f(int a) { return a; }", "int f(double a, int b) { return b; }"),
    "equal aliases": ("using A = B<C>;", "using A = B<C>;"),
    "using declarations": ("using std::numbers::pi;", "using std::numbers::pi;"),
    "members": ("int A::f(int a) { return a; }", "int A::f(int a) { return a; }"),
    "local names": ("int f() { int a = 1; return a; }", "int g() { int a = 2; return a; }"),
    "tests": ("TEST(A, B) { int a = 1; }", "TEST(A, B) { int a = 1; }"),
    "scoped enumerators": ("enum class A { kB };", "enum class C { kB };"),
    "comments": ("// int f(int a) { return a; }\n#define A int f(int a) \\\n  { return a; }", "int f(int a) { return a; }"),
}


def clashesOf(first: str, second: str) -> typing.List[str]:
    return list(unity_names.clashes("target", {"a.cpp": first, "b.cpp": second}))


def hidden(source: str, name: str = "pointrt") -> str:
    return f"#include <vector>\nnamespace {name} {{\nnamespace {{\n{source}\n}} // namespace\nint g() {{ return 1; }}\n}}\n"


class UnityNames(unittest.TestCase):
    def test_finds_clashes(self):
        for what, (first, second) in CLASHES.items():
            with self.subTest(what):
                self.assertEqual(len(clashesOf(hidden(first), hidden(second))), 1)

    def test_finds_nothing_else(self):
        for what, (first, second) in OTHERS.items():
            with self.subTest(what):
                self.assertEqual(clashesOf(hidden(first), hidden(second)), [])

    def test_names_of_other_namespaces_may_be_equal(self):
        source = "int f(int a) { return a; }"
        self.assertEqual(clashesOf(hidden(source), hidden(source, "other")), [])
        self.assertEqual(len(clashesOf(hidden(source, "a::b"), hidden(source, "a::b"))), 1)

    def test_finds_static_functions(self):
        source = "namespace pointrt {\nstatic int f(int a) { return a; }\n}"
        self.assertEqual(len(clashesOf(source, hidden("int f(int b) { return b; }"))), 1)
        self.assertEqual(clashesOf(source.replace("static ", ""), source), [])

    def test_names_the_sources(self):
        source = hidden("int f(int a) { return a; }")
        self.assertEqual(clashesOf(source, source), ["target: a.cpp and b.cpp both have f(int)"])


if __name__ == "__main__":
    unittest.main()
