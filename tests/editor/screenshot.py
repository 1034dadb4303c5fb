#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""screenshot - the window as the documents show it: screenshot.py docs/editor.png; `make screenshots`.

What is in a picture follows from its name: SCENES.
"""
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), 'person'))
import desk  # noqa: E402


def door(screen):
    """The door of the sample goes up, and the chart shows since when."""
    shutil.copytree(os.path.join(desk.ROOT, 'ladders'), os.path.join(screen.home, 'ladders'))
    editor = desk.Editor(screen, os.path.join(screen.home, 'ladders', 'garage-door.rung'))
    desk.until(lambda: editor.all('no problems', 'label'), 'the check')
    editor.find('Timing chart').press()
    editor.to_sheet()
    editor.keys('ctrl+r')
    for name in 'StopOk', 'BeamOk', 'MotorOk', 'ButtonUp':
        editor.click(editor.find('Input %s, ' % name, 'check box'))
    editor.element('Rung 3, COIL', 'MotorUp', ', on')
    desk.sh('sleep', '1.5')
    editor.keys('ctrl+r')
    editor.says('PAUSE')


def empty(screen):
    """What a newcomer sees first, of docs/tutorial.md."""
    editor = desk.Editor(screen)
    editor.focus_on('New project')
    editor.keys('Return')
    editor.to_sheet()
    editor.says('no problems')


def sealed(screen):
    """The tutorial's motor runs, and nobody holds Start."""
    path = os.path.join(screen.home, 'motor.rung')
    shutil.copy(os.path.join(desk.ROOT, 'docs', 'tutorial', '4-seal-in.rung'), path)
    editor = desk.Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+Home', 'ctrl+r')
    editor.says('SIMULATION')
    for now in 'closed', 'open':
        editor.keys('space')
        editor.element('Rung 1, NO', 'Start', now)
    editor.element('Rung 1, COIL', ', on')


def states(screen):
    """The machine of docs/flow-chart-to-st.md fills a bag."""
    path = os.path.join(screen.home, 'bags.rung')
    with open(os.path.join(desk.ROOT, 'docs', 'flow-chart-to-st.md'), encoding='utf-8') as page:
        program = re.search(r'^```rung bags.rung\n(.*?)^```', page.read(), re.DOTALL | re.MULTILINE).group(1)
    with open(path, 'w', encoding='utf-8') as file:
        file.write(program)
    editor = desk.Editor(screen, path)
    desk.until(lambda: editor.all('no problems', 'label'), 'the check')
    editor.keys('ctrl+r')
    for name in 'Bag', 'Start':
        editor.click(editor.find('Input %s, ' % name, 'check box'))
    desk.sh('sleep', '1.5')
    editor.keys('ctrl+r')
    editor.says('PAUSE')


SCENES = {'editor': (door, 1280, 800), 'empty': (empty, 1024, 640), 'sealed': (sealed, 1280, 640), 'states': (states, 1280, 900)}


def main(out):
    lacks = desk.missing()
    if lacks:
        sys.exit('screenshot: it needs ' + lacks)
    scene, width, height = SCENES[os.path.splitext(os.path.basename(out))[0]]
    screen = desk.Screen('%dx%dx24' % (width, height))
    try:
        scene(screen)
        # Nobody points at anything, and the last frame is drawn.
        desk.sh('xdotool', 'mousemove', str(width - 1), str(height - 1), 'sleep', '1.5')
        subprocess.run(['import', '-window', 'root', '+dither', '-colors', '96', '-strip', 'PNG8:' + out], check=True)
    finally:
        for editor in desk.editors[:]:
            editor.kill()
        screen.close()


main(sys.argv[1])
