#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""classic - a ClassicLadder project: its report, the original rungs, export, files dropped on the window."""
import gzip
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import LADDER, ROLES, ROOT, Chinese, Editor, check, main, new_file, sh, until  # noqa: E402

PROJECTS = os.path.join(ROOT, 'tests', 'classic', 'projects')
LOST = 'element 103 does not conduct'
CHINESE_LOST = '元件 103 不导通'
SIMPLE = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
'''
REAL = SIMPLE.replace('END_VAR', '  Level : REAL;\nEND_VAR').replace(
    'END_PROGRAM', 'RUNG\n  | [ Level > 1.5 ] | COIL Motor |\nEND_PROGRAM')


def read(path, how='r'):
    with open(path, how) as file:
        return file.read()


def opened(screen, name='linuxcnc.clp', kind=Editor, **env):
    path = os.path.join(screen.home, name)
    shutil.copy(os.path.join(PROJECTS, name), path)
    editor = kind(screen, path, **env)
    until(lambda: editor.all(name + ': ') or editor.all(name + '：'), 'the message')
    return editor


def report(editor):
    editor.click(editor.find('Show report', 'push button'))
    return editor.find(CHINESE_LOST if isinstance(editor, Chinese) else LOST, 'label')


def rows(editor):
    """The accessible names of the lines."""
    return [node.name for node in editor.all(': ') if node.name.startswith(('Left out', 'Changed', 'Refused'))]


def mouse(screen):
    """a message with a button opens the report; a line leads to its rung and shows its original"""
    editor = opened(screen)
    line = report(editor)
    editor.find('Original of the rung: Estop chain')  # of the rung at the cursor
    editor.shot('classic-report')
    editor.click(line)
    editor.find('Original of the rung: rung_1.csv')
    editor.click(line, count=2)
    editor.to_sheet()
    editor.says('Rung 3 · column A')
    editor.shot('classic-place')
    editor.find('Original of the rung: ')
    editor.keys('ctrl+alt+s')  # the symbols have no original
    until(lambda: not editor.all('Original of the rung: '), 'the original to go with its sheet')
    editor.shot('classic-none')


def keyboard(screen):
    """the same by keys; the original follows the cursor and says so when a rung has none"""
    editor = opened(screen)
    editor.to_sheet()
    editor.keys('ctrl+alt+o')
    editor.find('Original of the rung: Estop chain')
    editor.to_sheet()
    editor.brought('ctrl+g')
    editor.focus_on(role='text')
    editor.type('3')
    editor.keys('Return')
    editor.find('Original of the rung: rung_1.csv')
    editor.keys('Insert')
    editor.find('There is no original of this place')
    editor.keys('Escape', 'ctrl+z', 'ctrl+Home')
    editor.find('Original of the rung: Estop chain')
    editor.command('import or export report')
    editor.focus_on('Left out: element 103', 'table row')
    editor.keys('Return')
    editor.to_sheet()
    editor.says('Rung 3 · column A')


def edits(screen):
    """report lines follow their rungs: deleted, restored, moved; the report is closed and opened again"""
    editor = opened(screen)
    report(editor)
    until(lambda: any('Prog1, rung 3' in row for row in rows(editor)), 'the place')
    editor.click(editor.sheet())
    editor.to_sheet()
    editor.keys('ctrl+Home', 'ctrl+Delete')
    until(lambda: any('Prog1, rung 2' in row for row in rows(editor)), 'another place')
    editor.keys('ctrl+z')
    until(lambda: any('Prog1, rung 3' in row for row in rows(editor)), 'its place')
    editor.find('Original of the rung: Estop chain')
    editor.keys('alt+Down')
    editor.find('Original of the rung: Estop chain')
    editor.click(editor.find('Close the report', 'push button'))
    until(lambda: not editor.all('Report', 'page tab'), 'the report to be away')
    editor.to_sheet()
    editor.keys('ctrl+alt+o')
    editor.find(LOST, 'label')


def copied(screen):
    """the report is copied as text"""
    editor = opened(screen)
    report(editor)
    editor.click(editor.find('Copy the report', 'push button'))
    until(lambda: 'Left out\t' + LOST + '\trung_1.csv:24\tProg1, rung 3\n' in
          sh('xclip', '-o', '-selection', 'clipboard') + '\n', 'the text')


def trace(path):
    script = os.path.join(os.path.dirname(path), 'script')
    with open(script, 'w') as file:
        file.write('@print %Q0\n%I0=0\n%I0=1\n')
    return sh(LADDER, 'trace', path, script, '--changes')


def written(screen):
    """Save as .clprj, .clprjz, .clp writes a project that does the same; the document keeps its name and stays
    unsaved"""
    editor = Editor(screen, new_file(screen, SIMPLE))
    editor.to_sheet()
    editor.keys('slash')
    until(lambda: editor.all('• new'), 'the change')
    for name in 'a.clprj', 'a.clprjz', 'a.clp':
        path = os.path.join(screen.home, name)
        editor.give_path(path, 'ctrl+shift+s')
        until(lambda: os.path.exists(path), name)
        editor.says('Exported %s for ClassicLadder' % name)
        assert '%Q0=1' in trace(path), trace(path)
    assert gzip.decompress(read(path + 'rjz', 'rb')) == read(os.path.join(screen.home, 'a.clprj'), 'rb')
    assert editor.all('• new') and read(os.path.join(screen.home, 'new.rung')) == SIMPLE
    editor.shot('classic-written')


def saved(screen):
    """saved as a rung file of the same name, with its I/O map beside it; the ClassicLadder project is unchanged"""
    editor = opened(screen, 'members.clprj')
    before = read(os.path.join(screen.home, 'members.clprj'), 'rb')
    path = os.path.join(screen.home, 'members.rung')
    editor.to_sheet()
    editor.give_path(path, 'ctrl+shift+s')
    until(lambda: os.path.exists(path[:-4] + 'io'), 'the map')
    editor.says('together with its I/O map: members.io')
    check(path)
    sh(LADDER, 'import', os.path.join(screen.home, 'members.clprj'), '-o', os.path.join(screen.home, 'same.rung'))
    assert read(os.path.join(screen.home, 'same.io')) == read(path[:-4] + 'io')
    assert read(os.path.join(screen.home, 'members.clprj'), 'rb') == before
    editor.give_path(os.path.join(screen.home, 'back.clprj'), 'ctrl+shift+s')
    editor.says('Exported back.clprj for ClassicLadder; 1 item')


def exported(screen):
    """export by the list of commands; an existing file is replaced only after a question, however its ending was given"""
    editor = Editor(screen, new_file(screen, SIMPLE))
    path = os.path.join(screen.home, 'b.clprj')
    new_file(screen, 'precious', 'b.clprj')
    editor.to_sheet()
    for answer in 'Cancel', 'Replace':
        editor.brought(lambda: editor.command('export as classic'), 'Export as ClassicLadder')
        editor.type_path(path[:-6])
        editor.keys('Return')
        editor.find('Replace the file?')
        assert read(path) == 'precious'
        editor.answer(answer)
        editor.to_sheet()
    editor.says('Exported b.clprj')
    assert '%Q0=1' in trace(path)


def refused(screen):
    """an export that ClassicLadder cannot hold writes nothing; each reason leads to its rung"""
    editor = Editor(screen, new_file(screen, REAL))
    editor.to_sheet()
    path = os.path.join(screen.home, 'c.clprj')
    editor.give_path(path, 'ctrl+shift+s')
    editor.says('ClassicLadder cannot hold this project')
    editor.focus_on('Refused: ', 'table row')
    editor.shot('classic-refused')
    editor.keys('Return')
    editor.to_sheet()
    editor.says('Rung 2')
    assert not os.path.exists(path)


def source(screen, *paths):
    """A window with those files, in the corner, that acts as a file manager does."""
    screen.start('/usr/bin/python3', os.path.abspath(__file__), '--drag', *paths)
    window = until(lambda: sh('xdotool', 'search', '--onlyvisible', '--name', 'drop source'), 'the window of files')
    sh('xdotool', 'windowmove', '--sync', window.split()[0], '1200', '700')
    sh('xdotool', 'windowraise', window.split()[0])
    return 1280, 760


def dropped(screen):
    """dropped files: each program opens, one in this window, the others in new windows"""
    names = ['linuxcnc.clp', 'elements.clprj']
    paths = [shutil.copy(os.path.join(PROJECTS, name), screen.home) for name in names]
    paths += [new_file(screen, SIMPLE), new_file(screen, 'hello', 'letter.odt'),
              new_file(screen, 'scenario One\n', 'new.scn')]
    editor = Editor(screen)
    start = source(screen, *paths)
    before = len(editor.windows())
    x, y, _, height = editor.place()

    def edge():
        return sh('import', '-window', 'root', '-crop', '12x1+%d+%d' % (x, y + height // 2), 'txt:-')
    plain = edge()
    # The window keeps its frame while it accepts a drag; from another program the drag arrives late.
    editor.drag(start, editor.centre(editor.find('Project')), look='classic-drop', ready=lambda: edge() != plain)
    until(lambda: len(editor.windows()) == before + 2, 'the windows')
    for name in *names, 'new', 'new.scn':
        editor.says(name)
    editor.says('Cannot open letter.odt')
    until(lambda: any('GUI_E' in name for name in editor.cells()), 'the sheet of the first one')
    editor.shot('classic-dropped')


def small(screen):
    """report and originals in a small, dark, Chinese window"""
    for kind, name, env in ((Editor, 'light', {}), (Chinese, 'dark', {'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'})):
        editor = opened(screen, kind=kind, **env)
        editor.shot('classic-small-first-' + name)
        line = report(editor)
        editor.click(line)
        editor.shot('classic-small-' + name)
        sheet = editor.place(editor.sheet())[3]
        assert sheet >= 330, 'the report leaves %d of 700 px to the sheet' % sheet
        editor.keys('Return')
        until(lambda: (node := editor.focused()) and node.role != ROLES['table row'], 'the focus in the sheet')
        editor.finish()


small.size = '1024x700x24'


def drag(paths):
    """Drags from the window of source()."""
    import gi
    gi.require_version('Gtk', '4.0')
    from gi.repository import Gdk, Gio, GLib, Gtk
    listed = ''.join(Gio.File.new_for_path(path).get_uri() + '\r\n' for path in paths)

    def activate(application):
        files = Gtk.DragSource()
        files.set_content(Gdk.ContentProvider.new_for_bytes('text/uri-list', GLib.Bytes.new(listed.encode())))
        label = Gtk.Label(label='files')
        label.add_controller(files)
        Gtk.ApplicationWindow(application=application, title='drop source', default_width=160,
                              default_height=90, child=label).present()

    application = Gtk.Application(flags=Gio.ApplicationFlags.NON_UNIQUE)
    application.connect('activate', activate)
    application.run([])


def can_drag():
    import subprocess
    return subprocess.run(['/usr/bin/python3', '-c', 'import gi; gi.require_version("Gtk", "4.0")'],
                          capture_output=True).returncode == 0


if __name__ == '__main__':
    if sys.argv[1:2] == ['--drag']:
        drag(sys.argv[2:])
    else:
        main([mouse, keyboard, edits, copied, written, saved, exported, refused, small] + ([dropped] if can_drag() else []))
