"""Writes the tilde over a letter as a character reference, so that two of them strike nothing out."""

import json
import sys

if "supports" not in sys.argv:
    _, book = json.load(sys.stdin)
    print(json.dumps(book).replace(">~<", ">&#126;<"))
