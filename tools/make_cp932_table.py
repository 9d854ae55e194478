#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints src/text/cp932_table.inc: Windows code page 932 as Python's codec `cp932` maps it, which
follows Microsoft's best-fit table. One string of UTF-16 units a lead byte, trail bytes 0x40 to
0xFC, U+FFFD where there is no character."""

LEADS = [b for b in range(0x81, 0xFD) if not 0xA0 <= b <= 0xDF]


def cell(lead, trail):
    try:
        return bytes([lead, trail]).decode("cp932")
    except UnicodeDecodeError:
        return "\ufffd"


print("// SPDX-License-Identifier: MIT")
print("// Made by tools/make_cp932_table.py; do not edit.")
for lead in LEADS:
    units = "".join(f"\\x{ord(cell(lead, trail)):04x}" for trail in range(0x40, 0xFD))
    print(f'u"{units}",  // {lead:02x}')
