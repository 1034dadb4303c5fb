#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""screenshot - the window as the documents show it: screenshot.py docs/editor.png; `make screenshots`."""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), 'person'))
import desk  # noqa: E402


def simulate(editor):
    """The door of the sample goes up, and the chart shows since when."""
    editor.press(editor.find('Timing chart'))
    editor.to_sheet()
    editor.keys('ctrl+r')
    for name in 'StopOk', 'BeamOk', 'MotorOk', 'ButtonUp':
        editor.click(editor.find('Input %s, ' % name, 'check box'))
    editor.element('Rung 3, COIL', 'MotorUp', ', on')
    desk.sh('sleep', '1.5')
    editor.keys('ctrl+r')
    editor.says('PAUSE')


def main(out):
    lacks = desk.missing()
    if lacks:
        sys.exit('screenshot: it needs ' + lacks)
    screen = desk.Screen('1280x800x24')
    try:
        shutil.copytree(os.path.join(desk.ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
        editor = desk.Editor(screen, os.path.join(screen.home, 'ladders', 'garage-door.rung'))
        desk.until(lambda: editor.all('no problems', 'label'), 'the check')
        simulate(editor)
        # Nobody points at anything, and the last frame is drawn.
        desk.sh('xdotool', 'mousemove', '1279', '799', 'sleep', '1.5')
        subprocess.run(['import', '-window', 'root', '+dither', '-colors', '96', '-strip', 'PNG8:' + out], check=True)
    finally:
        for editor in desk.editors[:]:
            editor.kill()
        screen.close()


main(sys.argv[1])
