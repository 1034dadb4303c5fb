# SPDX-License-Identifier: MIT
"""report - runs the tests of a script at one desk and prints TAP.

Each test has a process, a home folder and editors of its own. A test may say `size`, of its screen: that
desk is for it alone. After a failure the next test gets a new desk.
"""
import os
import shutil
import sys
import time
import traceback
import warnings

from outcome import BUILD
from screen import Screen, sh

warnings.simplefilter('ignore')


def chosen(tests):
    """The tests that the command line names; with QUICK=ROOM… those whose `quick` is one of the rooms; otherwise
    all."""
    if sys.argv[1:]:
        named = [test for test in tests if test.__name__ in sys.argv[1:]]
        return named or sys.exit(f'no test has one of the names: {" ".join(sys.argv[1:])}')
    rooms = os.environ.get('QUICK', '').split()
    return [test for test in tests if getattr(test, 'quick', '') in rooms] or \
        (rooms and [test for test in tests if getattr(test, 'quick', '') == 'editor-gtk/window']) or tests


def report(tests, lacks, editors):
    """Returns the exit status. @lacks: missing programs; @editors: a list that tests fill with the editors they
    start."""
    if lacks:
        print('1..0 # SKIP needs ' + lacks)
        return 0
    screen, failed = None, 0
    for number, test in enumerate(tests, 1):
        size = getattr(test, 'size', '1440x900x24')
        if screen and screen.size != size:
            screen.close()
            screen = None
        if screen:
            screen.tidy()
        else:
            screen = Screen(size)
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            good = run(screen, number, test, editors)
            screen.end(screen.always)
            sys.stdout.flush()
            os._exit(not good)
        if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) != 0:
            failed = 1
            screen.close()
            screen = None
    if screen:
        screen.close()
    print('1..%d' % len(tests))
    return failed


def keep_log(editor, number):
    """Copies the log beside the pictures unless it is empty."""
    if os.environ.get('PICTURES') and os.path.getsize(editor.log):
        shutil.copy(editor.log, os.path.join(os.environ['PICTURES'], 'log-%d.txt' % number))


def keep_failure(number, test, error):
    """Keeps the places in the script and the error for the summary at the end of a long log."""
    folder, script = os.path.join(BUILD, 'failed'), os.path.basename(sys.argv[0])
    ways = ['%s:%d %s' % (os.path.basename(step.filename), step.lineno, step.line)
            for step in traceback.extract_tb(error.__traceback__)]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, '%s-%d' % (script, number)), 'w') as file:
        file.write('\n'.join([test.__doc__, *ways[1:5], repr(error)[:600], '']))


def run(screen, number, test, editors):
    """Runs one test; False if it failed."""
    begin = time.monotonic()
    try:
        test(screen)
        for editor in editors[:]:
            editor.finish()
            keep_log(editor, number)
        print('ok %d - %s # %.1f s' % (number, test.__doc__, time.monotonic() - begin))
        return True
    except Exception as error:
        print('not ok %d - %s' % (number, test.__doc__))
        keep_failure(number, test, error)
        print('# ' + ''.join(traceback.format_exception(error)[-3:]).replace('\n', '\n# '))
        if os.environ.get('PICTURES'):
            sh('import', '-window', 'root', os.path.join(os.environ['PICTURES'], 'failed-%d.png' % number))
        print('# ' + '\n# '.join(screen.told()))
    for editor in editors[:]:
        print('# ' + editor.logged().replace('\n', '\n# '))
        editor.kill()
    return False
