#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""trouble - what cannot be saved is told, and the work is kept."""
import ctypes
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, sh, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start |
END_PROGRAM
'''
PR_CAPBSET_DROP = 24


def mere_mortal():
    """Root may write anywhere; who is started without that right may not."""
    for capability in (1, 2, 3):  # DAC_OVERRIDE, DAC_READ_SEARCH, FOWNER
        ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)


def draw(editor):
    editor.to_sheet()
    editor.keys('End')
    editor.entry('Motor')
    until(lambda: len(editor.cells()) == 2, 'the coil')


def saved_well(path):
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


def read_only(screen):
    """a folder that cannot be written: a banner, the work kept, saved when it can be"""
    folder = os.path.join(screen.home, 'locked')
    os.mkdir(folder)
    path = new_file(screen, PROJECT, 'locked/a.rung')
    os.chmod(folder, 0o555)
    editor = Editor(screen, path, before=mere_mortal)
    draw(editor)
    editor.keys('ctrl+s')
    editor.says('ermission denied')
    editor.shot('trouble-read-only')
    editor.logs('system', 'ermission denied')
    editor.shot('trouble-log')
    assert open(path).read() == PROJECT and len(editor.cells()) == 2
    os.chmod(folder, 0o755)
    editor.save(path)
    saved_well(path)


def full_disk(screen):
    """a disk that is full: a banner, the old file and the work kept"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    draw(editor)
    sh('prlimit', '--pid', str(editor.process.pid), '--fsize=50:')
    editor.keys('ctrl+s')
    editor.says('File too large')
    assert open(path).read() == PROJECT and len(editor.cells()) == 2
    sh('prlimit', '--pid', str(editor.process.pid), '--fsize=unlimited:')
    editor.save(path)
    saved_well(path)


def vanished(screen):
    """the folder of the file is gone: a banner, the work kept"""
    os.mkdir(os.path.join(screen.home, 'gone'))
    path = new_file(screen, PROJECT, 'gone/a.rung')
    editor = Editor(screen, path)
    draw(editor)
    shutil.rmtree(os.path.dirname(path))
    editor.keys('ctrl+s')
    editor.says('No such file')
    assert len(editor.cells()) == 2
    os.mkdir(os.path.dirname(path))
    editor.save(path)
    saved_well(path)


def somebody_else(screen):
    """somebody else changes the file: it is told, and read again when wanted"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 1, 'the contact')
    with open(path, 'w') as file:
        file.write(PROJECT.replace('| NO Start |', '| NO Start | COIL Motor |'))
    editor.says('changed by somebody else')
    editor.shot('trouble-somebody-else')
    editor.logs('system', 'The file was changed by somebody else.')
    editor.click(editor.find('Read it again', 'push button'))
    until(lambda: len(editor.cells()) == 2, 'what the other wrote')
    saved_well(path)


main([read_only, full_disk, vanished, somebody_else])
