#!/usr/bin/env python3
"""Cuts the interface's fonts down to the characters that the interface and Western names need.

Needs fonttools and Debian's fonts-inter and fonts-jetbrains-mono. Inter's digits become its tabular ones, so that numbers
that change do not move sideways. Other characters are drawn by the browser (eframe's glyph fallback).
"""

from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTFont

UNICODES = [*range(0x20, 0x7F), *range(0xA0, 0x180), 0x2002, 0x2007, 0x2009, 0x200A, 0x202F, 0x2013, 0x2014, 0x2018, 0x2019,
            0x201C, 0x201D, 0x2022, 0x2026, 0x2190, 0x2191, 0x2192, 0x2193, 0x2212, 0x2248, 0x2264, 0x2265, 0x21E7, 0x2318]

SOURCES = {
    "Inter-Regular": "/usr/share/fonts/opentype/inter/Inter-Regular.otf",
    "Inter-SemiBold": "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
    "JetBrainsMono-Regular": "/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
}

for name, source in SOURCES.items():
    font = TTFont(source)
    tabular = {}
    for record in font["GSUB"].table.FeatureList.FeatureRecord:
        if record.FeatureTag == "tnum":
            for index in record.Feature.LookupListIndex:
                for table in font["GSUB"].table.LookupList.Lookup[index].SubTable:
                    tabular.update(getattr(table, "ExtSubTable", table).mapping)
    for table in font["cmap"].tables:
        for code in range(ord("0"), ord("9") + 1):
            if code in table.cmap:
                table.cmap[code] = tabular.get(table.cmap[code], table.cmap[code])
    options = subset.Options(layout_features=[], hinting=False, notdef_outline=True, name_IDs=[0, 1, 2, 13, 14])
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=UNICODES)
    subsetter.subset(font)
    suffix = ".otf" if "CFF " in font else ".ttf"
    target = Path(__file__).with_name(name + suffix)
    font.save(target)
    print(target.name, target.stat().st_size, "bytes")
