"""Runs the Python blocks of a Markdown page, one after the other, in the current directory.

usage: run_guide.py PAGE
Blocks that import what is not installed are skipped if it is OVITO; anything else that is missing ends with 77.
"""
import re
import sys

blocks = re.findall(r"^```python\n(.*?)^```$", open(sys.argv[1], encoding="utf-8").read(), re.M | re.S)
names = {}
for number, block in enumerate(blocks, 1):
    try:
        exec(compile(block, f"block {number}", "exec"), names)
    except ModuleNotFoundError as error:
        if error.name != "ovito":
            print(error)
            sys.exit(77)
print(len(blocks), "blocks")
