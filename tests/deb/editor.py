#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""editor - the editor of the package downloads PROGRAM to the board WHERE, by keys; check.py runs it."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../editor/person'))
from desk import Editor, main  # noqa: E402
from online import connect, press, says  # noqa: E402


def download(screen):
    """a new board is in STOP, without a program; after the download and Run it runs this one"""
    editor = Editor(screen, os.environ['PROGRAM'])
    editor.to_sheet()
    connect(editor, os.environ['WHERE'])
    says(editor, '· STOP')
    editor.shot('deb-new-board')
    editor.keys('ctrl+shift+l')
    editor.find('Download to ', 'label')
    editor.shot('deb-download')
    editor.keys('Return')
    says(editor, 'garage · STOP')
    says(editor, 'The board runs this program.')
    press(editor, 'Run')
    editor.find('Run the program on “garage”?', 'label')
    editor.keys('Return')
    says(editor, 'garage · RUN')
    editor.shot('deb-runs')


if __name__ == '__main__':
    main([download])
