# SPDX-License-Identifier: MIT
"""outcome - what a person's work produced: the saved file, checked and run."""
import os
import subprocess
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..', '..'))
BUILD = os.path.join(ROOT, os.environ.get('BUILD', 'build'))
LADDER = os.path.join(BUILD, 'ladder')


def check(path):
    """`ladder check` must succeed."""
    done = subprocess.run([LADDER, 'check', path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stderr


def trace(path, script):
    """The trace of the saved program."""
    with tempfile.NamedTemporaryFile('w', suffix='.script') as file:
        file.write(script)
        file.flush()
        done = subprocess.run([LADDER, 'trace', path, file.name], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def lines(path, script):
    """The last field of each line that `ladder trace` prints."""
    return [line.split()[-1] for line in trace(path, script).splitlines()]


def new_file(screen, text='RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n', name='new.rung'):
    path = os.path.join(screen.home, name)
    with open(path, 'w') as file:
        file.write(text)
    return path


def drafts(screen):
    """Paths of the drafts."""
    folder = os.path.join(screen.home, 'state', 'rungboard', 'drafts')
    names = os.listdir(folder) if os.path.isdir(folder) else []
    return [os.path.join(folder, name) for name in names if name.endswith('.draft')]  # completely written
