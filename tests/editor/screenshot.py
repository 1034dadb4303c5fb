#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""screenshot - the window as the documents show it: screenshot.py docs/editor.png; `make screenshots`."""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), 'person'))
import desk  # noqa: E402


def main(out):
    lacks = desk.missing()
    if lacks:
        sys.exit('screenshot: it needs ' + lacks)
    screen = desk.Screen('1280x800x24')
    try:
        shutil.copytree(os.path.join(desk.ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
        editor = desk.Editor(screen, os.path.join(screen.home, 'ladders', 'garage-door.rung'))
        desk.until(lambda: editor.all('no problems', 'label'), 'the check')
        editor.keys('Down', 'Down', 'Right')
        # Nobody points at anything, and the last frame is drawn.
        desk.sh('xdotool', 'mousemove', '1279', '799', 'sleep', '1.5')
        subprocess.run(['import', '-window', 'root', '+dither', '-colors', '96', '-strip', 'PNG8:' + out], check=True)
    finally:
        for editor in desk.editors[:]:
            editor.kill()
        screen.close()


main(sys.argv[1])
