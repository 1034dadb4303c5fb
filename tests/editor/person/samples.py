#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""samples - each file of ladders/ opens from the command line."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, main, until  # noqa: E402


def samples(screen):
    """each file of ladders/ opens: programs, scenarios and maps, each as its kind"""
    folder = os.path.join(ROOT, 'ladders')
    paths = [os.path.join(where, name) for where in (folder, os.path.join(folder, 'boards'))
             for name in sorted(os.listdir(where)) if name != 'boards']
    inside = [path for path in paths if os.path.isdir(path)]
    paths = [path for path in paths if path not in inside]
    # The scenarios of a folder of plain IEC text open that folder; a rung file in a folder has its name.
    folders = [path for path in inside if os.path.exists(os.path.join(path, 'main.st'))]
    assert folders and len(inside) > len(folders), inside
    for path in inside:
        name = os.path.basename(path)
        paths += [os.path.join(path, file) for file in sorted(os.listdir(path)) if file.split('.')[0] == name]
    texts = [os.path.basename(path) for path in paths if not path.endswith('.rung')]
    # A scenario or a map opens in the window of its program, if that is beside it.
    maps = [path for path in paths if path.endswith('.io') and not os.path.exists(path[:-3] + '.rung')]
    programs = [path for path in paths if path.endswith('.rung')]
    assert len(paths) == len(programs) + len(texts) and len(programs) > 20 and len(texts) > 20, paths
    editor = Editor(screen, *paths)
    until(lambda: len(editor.windows()) == len(programs) + len(maps) + len(folders), 'the windows')
    names = {node.name for node in editor.all()}
    assert not set(texts) - names, set(texts) - names
    told = [name for name in names if 'Text of the file' in name or 'RUNGBOARD' in name]
    assert not told, told


main([samples])
