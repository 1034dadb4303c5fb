#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""windows - rungs go from window to window, and from any text editor, as text."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402

SOURCE = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Stop AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Self-holding"
  | NO Start     | NC Stop | COIL Motor |
  | NO Motor ^   |
END_PROGRAM
'''
TARGET = SOURCE[:SOURCE.index('RUNG "')] + 'RUNG\nEND_PROGRAM\n'


def clipboard():
    return sh('timeout', '10', 'xclip', '-selection', 'clipboard', '-o')


def other_window(screen):
    """a rung copied in one window is pasted in another"""
    from_path, path = new_file(screen, SOURCE, 'from.rung'), new_file(screen, TARGET, 'to.rung')
    one = Editor(screen, from_path)
    one.to_sheet()
    one.keys('ctrl+a', 'ctrl+c')
    assert 'RUNG "Self-holding"' in until(lambda: clipboard() or None, 'text on the clipboard')
    two = Editor(screen, path)
    two.front()
    two.to_sheet()
    two.keys('ctrl+v')
    until(lambda: len(two.cells()) == 4, 'the elements')
    two.shot('windows-pasted')
    text = two.save(path)
    assert text.count('Self-holding') == 1, text
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\nStop=1\n') == ['Motor=1', 'Motor=1', 'Motor=0']
    one.front()
    one.keys('ctrl+z')
    assert open(from_path).read() == SOURCE


def from_text(screen):
    """a rung typed in any text editor is pasted"""
    path = new_file(screen, TARGET)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.put_clipboard('RUNG\n  | NO Start | COIL Motor |\n')
    editor.keys('ctrl+v')
    until(lambda: len(editor.cells()) == 2, 'the elements')
    editor.save(path)
    check(path)
    assert lines(path, '@print Motor\nStart=1\nStart=0\n') == ['Motor=1', 'Motor=0']
    editor.put_clipboard('this is no rung')
    editor.keys('ctrl+v')
    assert len(editor.cells()) == 2, 'what is no rung was pasted'


main([other_window, from_text])
