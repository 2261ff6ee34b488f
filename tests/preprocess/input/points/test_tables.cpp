// SPDX-License-Identifier: Apache-2.0
// Tables as spreadsheets, surveyors and loggers write them.
#include <random>

#include "tests/preprocess/input/input_fixture.h"

#include "preprocess/ingest/axis_names.h"
#include "preprocess/ingest/table.h"

namespace pointrt {
namespace {

struct TableTest : InputTest {
    void expectPoints(const std::string& text, const std::vector<Vec3d>& points) const {
        const Cloud cloud = readText("a.csv", text);
        ASSERT_EQ(cloud.positions.size(), points.size()) << text;
        for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(world(cloud, i), points[i]) << text;
    }
};

std::vector<std::string> fieldsOf(std::string_view line, char delimiter) {
    std::vector<std::string> all;
    Fields fields{line, delimiter};
    for (std::string_view field; fields.next(field);) all.emplace_back(field);
    return all;
}

TEST_F(TableTest, QuotedFieldsHoldDelimiters) {
    EXPECT_EQ(fieldsOf(R"(1,"a, b","say ""no""",4)", ','), (Names{"1", "a, b", R"(say ""no"")", "4"}));
    EXPECT_EQ(fieldsOf(R"( "a;b" ; 2;)", ';'), (Names{"a;b", "2", ""}));
    EXPECT_EQ(fieldsOf("1\t\t3", '\t'), (Names{"1", "", "3"}));
    EXPECT_EQ(fieldsOf(R"("a b" 2)", ' '), (Names{"a b", "2"}));
    EXPECT_EQ(fieldsOf(R"(5" pipe,2)", ','), (Names{R"(5" pipe)", "2"}));
    EXPECT_EQ(fieldsOf(R"("5,2)", ','), (Names{R"("5)", "2"}));
}

TEST_F(TableTest, QuotedFieldsHoldLineEnds) {
    expectPoints("note,x,y,z\n\"a\nb\",1,2,3\nc,4,5,6\n", {{1, 2, 3}, {4, 5, 6}});
    expectPoints("x,y,z\r1,2,3\r4,5,6\r", {{1, 2, 3}, {4, 5, 6}}); // "CSV (Macintosh)"
    // an unclosed quote does not swallow the points after it
    expectPoints("note,x,y,z\n\"5 inch,1,2,3\nc,4,5,6\n", {{1, 2, 3}, {4, 5, 6}});
}

TEST_F(TableTest, DecimalCommasAreRead) {
    const std::vector<Vec3d> points = {{1.5, 2.25, 3}, {4, 5.5, 6.75}};
    expectPoints("x,y,z\n\"1,5\",\"2,25\",\"3\"\n\"4\",\"5,5\",\"6,75\"\n", points);
    expectPoints("x;y;z\n1,5;2,25;3\n4;5,5;6,75\n", points);
    expectPoints("1,5 2,25 3,0\n4 5,5 6,75\n", points);
    expectPoints("1,5\t2,25\t3\n4\t5,5\t6,75\n", points);
    expectPoints("sep=;\nx;y;z\n1,5;2,25;3\n4;5,5;6,75\n", points);
    expectPoints("sep=\t\r\nx\ty\tz\r\n1,5\t2,25\t3\r\n4\t5,5\t6,75\r\n", points);
    expectPoints("1, 2, 3\n4, 5, 6\n", {{1, 2, 3}, {4, 5, 6}});
}

TEST_F(TableTest, MixedDecimalMarksAreRefused) {
    EXPECT_HAS(reasonOfText("a.csv", "x;y;z\n1,5;2,5;3,5\n1.5;2;3\n"), "a.csv:3: *decimal commas");
    EXPECT_HAS(reasonOfText("b.csv", "x;y;z\n1.5;2.5;3.5\n1;2,5;3\n"), "b.csv:3: *decimal commas");
    EXPECT_HAS(reasonOfText("c.csv", "x;y;z\n1,234.5;2;3\n1.234,5;2;3\n"), "c.csv:3: *decimal commas");
    EXPECT_HAS(reasonOfText("d.csv", "x;y;z\n1'234.5;2;3\n1 234.5;2;3\n"), "d.csv:3: *thousands");
    EXPECT_HAS(reasonOfText("e.csv", "x;y;z\n1,23,456;2;3\n"), "e.csv:2: *column 1");
    EXPECT_HAS(reasonOfText("f.csv", "x;y;z\n1.5;2;3\n0,123;2;3\n"), "f.csv:3: *decimal commas");
}

TEST_F(TableTest, ThousandsSeparatorsAreRead) {
    const std::vector<Vec3d> points = {{512345.5, 5403210.25, 350}, {-1234, 999.5, 1000}};
    expectPoints("x;y;z\n512,345.5;5,403,210.25;350\n-1,234;999.5;1,000\n", points);
    expectPoints("x;y;z\n512.345,5;5.403.210,25;350\n-1.234;999,5;1.000\n", points);
    expectPoints("x,y,z\n\"512,345.5\",\"5,403,210.25\",350\n\"-1,234\",999.5,\"1,000\"\n", points);
    expectPoints("x,y,z\n\"512.345,5\",\"5.403.210,25\",\"350\"\n\"-1.234\",\"999,5\",\"1.000\"\n", points);
    expectPoints("x,y,z\n512'345.5,5'403'210.25,350\n-1'234,999.5,1'000\n", points);
    expectPoints("512'345.5 5'403'210.25 350\n-1'234 999.5 1'000\n", points);
    expectPoints("512,345.5 5,403,210.25 350\n-1,234 999.5 1,000\n", points);
    expectPoints("x\ty\tz\n512 345,5\t5 403 210,25\t350\n-1 234\t999,5\t1 000\n", points);
    expectPoints("512 345,5\t5 403 210,25\t350\n-1 234\t999,5\t1 000\n", points);
    for (const std::string group :
         {"\xc2\xa0", "\xe2\x80\xaf", "\xe2\x80\x99"}) // blanks that do not break, Swiss quote
        expectPoints("x;y;z\n512" + group + "345,5;5" + group + "403" + group + "210,25;350\n-1234;999,5;1" + group +
                         "000\n",
                     points);
    // the separators come late: nothing before them reads differently
    expectPoints("x;y;z\n1;2;3.5\n1,234;2;3\n", {{1, 2, 3.5}, {1234, 2, 3}});
    expectPoints("1 200\t3\n4 5\t6\n", {{1, 200, 3}, {4, 5, 6}});
}

TEST_F(TableTest, CommasThatMayBeEitherAreSaid) {
    const Cloud cloud = readText("a.csv", "x;y;z\n1,250;2,500;3\n");
    EXPECT_EQ(world(cloud, 0), Vec3d(1.25, 2.5, 3));
    EXPECT_HAS(notesOf(cloud), "a.csv: *1,234*decimal commas");
    EXPECT_EQ(notesOf(readText("b.csv", "x;y;z\n1,234;2,5;3\n")), "");
    // behind the numbers that are surveyed
    std::string text = "x;y;z\n";
    for (int i = 0; i < 1000; ++i) text += fmt::format("{};{};7\n", i % 999, i);
    EXPECT_HAS(reasonOfText("c.csv", text + "1,234;2;3\n"), "c.csv:1002: *1,234 may be either");
    EXPECT_EQ(readText("d.csv", text + "1,5;2;3\n").positions.size(), 1001u);
}

TEST_F(TableTest, MissingCoordinatesLeaveThePointOut) {
    for (const char* missing : {"", "NA", "n/a", "null", "-", "#N/A", "NaN", "None", "*"}) {
        const Cloud cloud = readText(
            "a.csv", fmt::format("x,y,z,w\n1,2,{},4\n5,6,7,8\n{},2,3,4\n1,{},3,4\n", missing, missing, missing));
        ASSERT_EQ(cloud.positions.size(), 1u) << missing;
        EXPECT_EQ(world(cloud, 0), Vec3d(5, 6, 7));
        EXPECT_EQ(cloud.points_read, 4u);
        EXPECT_EQ(cloud.points_non_finite, 3u);
    }
    EXPECT_HAS(notesOf(readText("a.csv", "x,y,z\n1,2,\n5,6,7\n")), "1 point*left out");
    for (const char* missing : {"NoData", "-", "#N/A", "*"}) // at the start of the file
        expectPoints(fmt::format("1 2 {}\n5 6 7\n", missing), {{5, 6, 7}});
    expectPoints("x\ty\tz\n\t2\t3\n1\t\t3\n5\t6\t7\n", {{5, 6, 7}});
    EXPECT_HAS(reasonOfText("a.csv", "x,y,z\n1,2,three\n"), "a.csv:2: column 3");
    EXPECT_HAS(reasonOfText("a.csv", "x,y,z\n1,2\n"), "a.csv:2: *2 columns");
}

TEST_F(TableTest, AxesHaveManyNames) {
    for (const char* header :
         {"Easting,Northing,Elevation", "E,N,Z", "east,north,height", "X_coord,Y_coord,Z_coord", "pos_x,pos_y,pos_z",
          "Point X,Point Y,Point Z", "x_m,y_m,alt", "Rechtswert,Hochwert,Höhe", "coordX,coordY,coordZ",
          "X (metres),Y (metres),Z (metres)", "utm_easting,utm_northing,H", "x,y,h", "world_x,world_y,world_z",
          "Points:0,Points:1,Points:2", "Points_0,Points_1,Points_2", "Este,Norte,Cota",
          "cartesianX,cartesianY,cartesianZ"})
        expectPoints(std::string(header) + "\n1,2,3\n", {{1, 2, 3}});
    expectPoints("P,N,E,Z,D\n1,20,10,5,tree\n2,21,11,6,kerb\n", {{10, 20, 5}, {11, 21, 6}});
    expectPoints("Point Number,Northing,Easting,Elevation,Description\nA1,20,10,5,\"tree, old\"\n", {{10, 20, 5}});
    // x, y and z keep their names
    expectPoints("height,e,n,x,y,z\n9,9,9,1,2,3\n", {{1, 2, 3}});
    expectPoints("lat,lon,x,y,z\n9,9,1,2,3\n", {{1, 2, 3}});
    EXPECT_HAS(reasonOfText("a.csv", "a,b,c\n1,2,3\n"), "a.csv:1: *header");
}

TEST_F(TableTest, BarsAndPercentSignsAreRead) {
    expectPoints("x|y|z\n1|2|3\n4|5|6\n", {{1, 2, 3}, {4, 5, 6}});
    expectPoints("1 2 3 | a remark\n4 5 6 | another\n", {{1, 2, 3}, {4, 5, 6}});
    expectPoints("% written by a program\n% z y x\n3 2 1\n", {{1, 2, 3}});
}

TEST_F(TableTest, ColumnNumbersArePandasHeader) {
    expectPoints("0,1,2\n1.5,2,3\n", {{1.5, 2, 3}});
    expectPoints(",0,1,2\n0,1.5,2,3\n", {{1.5, 2, 3}});
    expectPoints("0,1,2\n1,2,3\n", {{0, 1, 2}, {1, 2, 3}}); // integers, like the other rows
    expectPoints("0,1,3\n1.5,2,3\n", {{0, 1, 3}, {1.5, 2, 3}});
}

TEST_F(TableTest, LongitudesAndLatitudesAreDegrees) {
    const std::string path = write("a.csv", "latitude,longitude,height\n45,7,100\n45.001,7.001,112\n");
    ReadOptions options;
    options.scales_degrees = true;
    const Cloud cloud = read(path, options);
    EXPECT_HAS(notesOf(cloud), "is in degrees: *metres");
    EXPECT_NEAR(world(cloud, 1).y() - world(cloud, 0).y(), 111.13, 0.05); // degrees of a thousandth at 45 degrees north
    EXPECT_NEAR(world(cloud, 1).x() - world(cloud, 0).x(), 78.85, 0.05);
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    EXPECT_HAS(notesOf(read(path)), "is in degrees: *unit");
}

/// Rows of "lead x y z tail" around 512345, 5403210, 350.
std::string surveyed(const std::function<std::string(int)>& lead, const std::string& tail = "", int rows = 12) {
    std::string text;
    for (int i = 0; i < rows; ++i)
        text += fmt::format("{} {:.3f} {:.3f} {:.3f}{}\n", lead(i), 512345 + 1.5 * (i % 4), 5403210 + 1.5 * (i / 4),
                            350 + 0.1 * i, tail);
    return text;
}

TEST_F(TableTest, NumbersAndTimesPrecedeCoordinates) {
    const auto expectLead = [&](const std::string& text, const char* name, double second) {
        const Cloud cloud = readText("a.txt", text);
        EXPECT_EQ(world(cloud, 0), Vec3d(512345, 5403210, 350)) << text;
        EXPECT_EQ(attributeNames(cloud).at(0), name);
        EXPECT_EQ(numbersOf(cloud, name).at(1), second);
        EXPECT_HAS(notesOf(cloud), fmt::format("column 1 *{}", name));
    };
    expectLead(surveyed([](int i) { return std::to_string(i + 1); }), "number", 2);
    expectLead(surveyed([](int i) { return std::to_string(3 * i); }), "number", 3);
    expectLead(surveyed([](int i) { return std::to_string(i + 7); }, " 10 20 30"), "number", 8);
    expectLead(surveyed([](int i) { return fmt::format("{}.25", 1500000000 + i / 2); }), "time", 1500000000.25);
    expectLead(surveyed([](int i) { return fmt::format("{:.2f}", 348123 + 0.25 * i); }), "time", 348123.25);
    const Cloud colored = readText("a.txt", surveyed([](int i) { return std::to_string(i); }, " 10 20 30"));
    EXPECT_EQ(colored.colors.at(0), (Rgb8{10, 20, 30}));
}

TEST_F(TableTest, AscendingCoordinatesStay) {
    std::string profile, grid, sorted;
    for (int i = 0; i < 20; ++i) {
        profile += fmt::format("{} 0 {} 7\n", i + 1, 0.5 * (i % 3));
        grid += fmt::format("{} {} 0 7\n", i / 4, i % 4);
        sorted += fmt::format("{:.3f} {:.3f} {:.3f} 7\n", 0.37 * i, 0.5 * (i % 5), 0.25 * (i % 3));
    }
    for (const std::string& text : {profile, grid, sorted, std::string("1 5 9 7\n2 6 8 7\n3 7 7 7\n")}) {
        const Cloud cloud = readText("a.txt", text);
        EXPECT_EQ(world(cloud, 1).x(), text == profile ? 2 : text == grid ? 0 : text == sorted ? 0.37f : 2.0) << text;
    }
}

TEST_F(TableTest, ListsOfSurveyors) {
    // number, northing, easting, height, description: recognised by the ranges of UTM
    const Cloud cloud = readText("a.txt", "1,5403210.5,512345.25,344.5,tree\n2,5403211,512346,345,\"kerb, low\"\n");
    EXPECT_EQ(world(cloud, 0), Vec3d(512345.25, 5403210.5, 344.5));
    EXPECT_HAS(notesOf(cloud), "column 1 *number *north, east");
    const Cloud east_first = readText("a.txt", "1,512345.25,5403210.5,344.5,tree\n2,512346,5403211,345,kerb\n");
    EXPECT_EQ(world(east_first, 0), Vec3d(512345.25, 5403210.5, 344.5));
    // names and dates are words
    expectPoints("P1,10.5,20.5,5,tree\nP2,11.5,21,6,kerb\n", {{10.5, 20.5, 5}, {11.5, 21, 6}});
    expectPoints("2024-05-01 12:00:01.5 1 2 3\n2024-05-01 12:00:02 4 5 6\n", {{1, 2, 3}, {4, 5, 6}});
}

/// Red, green and blue of photographs resemble each other; a label or an intensity does not resemble them.
TEST_F(TableTest, ColorsStandBesideTwoOtherColumns) {
    std::mt19937 random(7);
    const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    std::string label_and_object, intensity_and_label;
    for (int i = 0; i < 200; ++i) {
        const int grey = 20 + below(200);
        const std::string xyz = fmt::format("{} {} {}", i % 20 * 0.5, i / 20 * 0.5, below(9) * 0.1);
        const std::string rgb = i == 0 ? "200 150 100" : fmt::format("{} {} {}", grey, grey + 9, grey + below(20));
        label_and_object += fmt::format("{} {} {} {}\n", xyz, rgb, i % 13, i / 10 * 7);
        intensity_and_label += fmt::format("{} {} {} {}\n", xyz, below(4096), rgb, i % 13);
    }
    const Cloud objects = readText("objects.txt", label_and_object),
                classes = readText("classes.txt", intensity_and_label);
    for (const Cloud* cloud : {&objects, &classes}) EXPECT_EQ(cloud->colors.at(0), (Rgb8{200, 150, 100}));
    EXPECT_EQ(attributeNames(objects), (Names{"label"}));
    EXPECT_HAS(notesOf(objects), "columns 4 to 6 are read as red, green and blue, the one beside them as 'label', the "
                                 "last is not read");
    EXPECT_EQ(attributeNames(classes), (Names{"intensity", "label"}));
    EXPECT_HAS(notesOf(classes), "columns 5 to 7 are read as red, green and blue, the last as 'label'");
}

TEST_F(TableTest, TitlesAndUnitsAroundTheHeaderAreLeftOut) {
    const Cloud cloud =
        readText("a.csv", "Survey of the castle\n3 May 2020\nx,y,z,intensity\nm,m,m,-\n1,2,3,7\n4,5,6,8\n");
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(attributeNames(cloud), (Names{"intensity"}));
    EXPECT_HAS(notesOf(cloud), "not read: 'Survey of the castle', '3 May 2020', 'm,m,m,-'");
    EXPECT_HAS(reasonOfText("a.txt", "Survey of the castle\n1 2 3\n4 5 6\n"),
               ":1: *neither a point nor a header*castle");
    std::string titles;
    for (int i = 0; i < 11; ++i) titles += "title\n";
    EXPECT_HAS(reasonOfText("a.txt", titles + "x y z\n1 2 3\n"), ":1: *neither a point nor a header");
    EXPECT_HAS(reasonOfText("a.csv", "x,y,z\nm,m,m\nm,m,m\n1,2,3\n"), "a.csv:3: *not a number");
}

TEST_F(TableTest, HeightsAreNamedInLatin1) {
    EXPECT_EQ(readText("a.csv", "Rechtswert;Hochwert;H\xf6he;Art\n3;4;5;Eiche\n6;7;9;Buche\n").positions.size(), 2u);
}

TEST_F(TableTest, ColorsAreToldFromLabelsAndIntensities) {
    std::mt19937 random(7);
    const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    std::string labels, labels_first, intensities, intensities_first;
    for (int i = 0; i < 200; ++i) {
        const int grey = 20 + below(200), label = below(13), intensity = below(256);
        const std::string xyz = fmt::format("{} {} {}", i % 20 * 0.5, i / 20 * 0.5, below(9) * 0.1);
        const std::string rgb = i == 0 ? "200 150 100" : fmt::format("{} {} {}", grey, grey + 9, grey + below(20));
        labels += fmt::format("{} {} {}\n", xyz, rgb, label);
        labels_first += fmt::format("{} {} {}\n", xyz, label, rgb);
        intensities += fmt::format("{} {} {}\n", xyz, rgb, intensity);
        intensities_first += fmt::format("{} {} {}\n", xyz, intensity, rgb);
    }
    for (const std::string& text : {labels, labels_first, intensities, intensities_first}) {
        const Cloud cloud = readText("a.txt", text);
        EXPECT_EQ(cloud.colors.at(0), (Rgb8{200, 150, 100})) << text.substr(0, 30);
        EXPECT_HAS(notesOf(cloud), "red, green and blue");
        if (text == labels || text == labels_first) {
            EXPECT_EQ(attributeNames(cloud), (Names{"label"}));
        }
    }
}

} // namespace
} // namespace pointrt
