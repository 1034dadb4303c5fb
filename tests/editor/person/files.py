#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""files - files that are no program are reported, files stay as they are, and no file of others is replaced without
a question.
"""
import os
import stat
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, lines, main, new_file, until  # noqa: E402
from projects import ONE_RUNG  # noqa: E402

SCENARIO = 'scenario One\n'
NO_FILE = 'not a regular file'
TOO_LARGE = 'file is too large: 1.1\N{NO-BREAK SPACE}TB, at most 67.1\N{NO-BREAK SPACE}MB'


def read(path):
    with open(path) as file:
        return file.read()


def write(path, text):
    with open(path, 'w') as file:
        file.write(text)


def refused(screen):
    """a device, a pipe, a folder and a large file each give a banner and an empty sheet; no file is touched"""
    pipe, folder, large = [os.path.join(screen.home, name) for name in ('pipe', 'folder', 'large.rung')]
    os.mkfifo(pipe)
    os.mkdir(folder)
    with open(large, 'w') as file:
        file.truncate(1 << 40)
    for path, why in ('/dev/zero', NO_FILE), (pipe, NO_FILE), (folder, NO_FILE), (large, TOO_LARGE):
        editor = Editor(screen, path)
        editor.says(path + ': ' + why)
        editor.says('not saved yet')
        editor.to_sheet()
        editor.shot('files-refused-' + os.path.basename(path))
        editor.finish()


def classic(screen):
    """a ClassicLadder project opens as a new unsaved rung file with a report"""
    project = os.path.join(screen.home, 'pump.txt')
    cells = ' , '.join(['9-0-0-0'] * 8)
    write(project, ';Rung:\n#LABEL=\n#COMMENT=The pump\n1-0-50-0 , 103-0-0-0 , ' + cells[:-10] +
          ' , 50-0-60-0\n1-0-60-1 , 9-0-0-0 , ' + cells[:-10] + ' , 50-0-60-1\n')
    before = read(project)
    editor = Editor(screen, project)
    editor.says('not saved yet')
    editor.click(editor.find('Show report', 'push button'))
    editor.says('element 103 does not conduct')
    editor.shot('files-classic')
    editor.finish()
    assert read(project) == before


LIST = 'PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\n  LD    n\n  ADD   1\n  ST    n\nEND_PROGRAM\n'
OBJECT = ('<?xml version="1.0"?>\n<TcPlcObject><POU Name="Main"><Declaration><![CDATA[PROGRAM Main\nVAR\n  n : INT;\n'
          'END_VAR\n]]></Declaration><Implementation><IL><![CDATA[  LD n\n  ST n\n]]></IL></Implementation></POU></TcPlcObject>\n')


def plain(screen):
    """plain IEC text opens as it is and is saved in its own form; an object of TwinCAT becomes a new document"""
    path, other = os.path.join(screen.home, 'count.il'), os.path.join(screen.home, 'Main.TcPOU')
    write(path, LIST)
    write(other, OBJECT)
    editor = Editor(screen, path)
    editor.says('count.il')
    editor.shot('files-plain')
    view = next(view for view in editor.all(role='text') if 'LD' in view.text())
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the list')
    editor.keys('ctrl+End', 'Up')
    editor.type('  ST    n')
    editor.keys('Return')
    editor.keys('ctrl+s')
    until(lambda: read(path) != LIST, 'it to be saved')
    assert read(path) == LIST.replace('END_PROGRAM', '  ST    n\nEND_PROGRAM'), read(path)
    check(path)
    editor.finish()
    editor = Editor(screen, other)
    editor.says('not saved yet')
    editor.shot('files-twincat')
    editor.finish()
    assert read(other) == OBJECT


def no_program(screen):
    """an empty and a binary file open as text with their problems; the files are untouched"""
    empty, binary = [os.path.join(screen.home, name) for name in ('empty.rung', 'binary.rung')]
    write(empty, '')
    with open(binary, 'wb') as file:
        file.write(bytes(range(256)) * 4)
    for path, told in (empty, 'error'), (binary, 'bytes that are not UTF-8 text'):
        editor = Editor(screen, path)
        editor.says(told)
        editor.says('error')
        editor.shot('files-' + os.path.basename(path))
        editor.finish()
    assert read(empty) == '' and os.path.getsize(binary) == 1024


def no_text(screen):
    """bytes that are not UTF-8 give a banner; saving asks once more, saving as another file keeps them"""
    path = os.path.join(screen.home, 'old.rung')
    old = ONE_RUNG.replace('PROGRAM Main', '(* Gr\xfc\xdfe *)\nPROGRAM Main').encode('latin-1')
    with open(path, 'wb') as file:
        file.write(old)
    editor = Editor(screen, path)
    editor.says('bytes that are not UTF-8 text')
    editor.find('Save as…', 'push button')
    editor.to_sheet()
    editor.keys('slash', 'ctrl+s')
    editor.find('Save anyway', 'push button')
    editor.shot('files-no-text')
    with open(path, 'rb') as file:
        assert file.read() == old
    other = os.path.join(screen.home, 'new.rung')
    editor.give_path(other, 'ctrl+shift+s')
    until(lambda: os.path.exists(other) and 'NC Start' in read(other), 'the other file')
    with open(path, 'rb') as file:
        assert file.read() == old
    until(lambda: not editor.all('Save anyway'), 'the banner to be gone')
    editor.to_sheet()
    editor.keys('slash')
    assert 'NO Start' in editor.save(other)
    editor.finish()
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash', 'ctrl+s')
    editor.click(editor.find('Save anyway', 'push button'))
    until(lambda: b'NC Start' in open(path, 'rb').read(), 'the file to be saved')
    check(path)


def foreign(screen):
    """Save as with the ending of a scenario, map or table adds .rung, and the title says so; its own ending stays"""
    editor = Editor(screen, new_file(screen, ONE_RUNG))
    editor.to_sheet()
    for name in 'pump.scn', 'pump.io', 'pump.txt', 'pump', 'pump.v2':
        path = os.path.join(screen.home, name)
        editor.give_path(path, 'ctrl+shift+s')
        until(lambda: os.path.exists(path + '.rung'), 'the file with its ending')
        editor.find(name + '.rung', 'label')
        assert read(path + '.rung') == ONE_RUNG and not os.path.exists(path)
    editor.shot('files-foreign')
    check(path + '.rung')
    old, new = os.path.join(screen.home, 'old.TXT'), os.path.join(screen.home, 'new.txt')
    write(old, ONE_RUNG)
    editor = Editor(screen, old)
    editor.to_sheet()
    editor.give_path(new, 'ctrl+shift+s')
    until(lambda: os.path.exists(new) and read(new) == ONE_RUNG, 'the other file')
    assert not os.path.exists(new + '.rung')


def beside(screen):
    """a scenario opens in the only project of its folder, a map in the project of its name, others in an empty one"""
    for name in 'pump.rung', 'pump.plant.rung', 'boards/pump.io', 'morning.scn', 'far/lone.scn', 'far/lone.io':
        os.makedirs(os.path.dirname(os.path.join(screen.home, name)), exist_ok=True)
        write(os.path.join(screen.home, name), ONE_RUNG if name.endswith('.rung') else SCENARIO if
              name.endswith('.scn') else '%IX0.0  sim\n')
    scenario = os.path.join(screen.home, 'morning.scn')
    editor = Editor(screen, scenario)
    editor.find('morning.scn', 'text')
    editor.says(os.path.join('~', 'pump.rung'))
    editor.give_path(os.path.join(screen.home, 'boards', 'pump.io'), 'ctrl+o')
    editor.find('%IX0.0, Driver')
    assert len(editor.windows()) == 1
    editor.give_path(os.path.join(screen.home, 'far', 'lone.scn'), 'ctrl+o')
    editor.find('lone.scn', 'text')
    editor.find('New project', 'label')
    editor.shot('files-beside')
    assert len(editor.windows()) == 2
    # That window is still empty: a second file fits there.
    editor.give_path(os.path.join(screen.home, 'far', 'lone.io'), 'ctrl+o')
    editor.find('lone.io')
    assert len(editor.windows()) == 2 and not editor.all('Text of the file')
    # An open file is shown where it is.
    editor.give_path(scenario, 'ctrl+o')
    editor.give_path(os.path.join(screen.home, 'far', 'lone.scn'), 'ctrl+o')
    assert len(editor.windows()) == 2
    editor.finish()
    # A map in a folder of several programs belongs to the one that lists it.
    write(os.path.join(screen.home, 'fan.rung'), ONE_RUNG)
    panel = os.path.join(screen.home, 'boards', 'panel.io')
    os.rename(os.path.join(screen.home, 'far', 'lone.io'), panel)
    editor = Editor(screen, os.path.join(screen.home, 'pump.rung'))
    editor.give_path(panel, 'ctrl+o')
    editor.find('%IX0.0, Driver')
    assert len(editor.windows()) == 1
    editor.finish()
    editor = Editor(screen, os.path.join(screen.home, 'none.scn'))
    editor.says('none.scn: cannot read this file')


def stays_a_link(screen):
    """saving through a link keeps the link and the permissions of the target; under any name it opens once"""
    os.mkdir(os.path.join(screen.home, 'there'))
    path = new_file(screen, ONE_RUNG, 'there/real.rung')
    link = os.path.join(screen.home, 'link.rung')
    os.symlink('there/real.rung', link)
    os.chmod(path, 0o640)
    os.link(path, os.path.join(screen.home, 'hard.rung'))
    editor = Editor(screen, link)
    editor.to_sheet()
    editor.keys('slash')
    for name in 'there/real.rung', 'hard.rung', 'link.rung':
        editor.give_path(os.path.join(screen.home, name), 'ctrl+o')
        editor.to_sheet()
        assert len(editor.windows()) == 1, name
    assert 'NC Start' in editor.save(path)
    assert os.readlink(link) == 'there/real.rung' and os.listdir(os.path.dirname(path)) == ['real.rung']
    assert stat.S_IMODE(os.stat(path).st_mode) == 0o640
    check(link)
    assert lines(link, '@print Motor\nStart=0\nStart=1\n') == ['Motor=1', 'Motor=0']


def scenario(screen):
    """An editor with a changed scenario in front; its path."""
    path = new_file(screen, ONE_RUNG)
    beside = os.path.join(screen.home, 'new.scn')
    write(beside, SCENARIO)
    editor = Editor(screen, path)
    editor.click(editor.find('new.scn', 'label'), count=2)
    change(editor, '# mine\n')
    return editor, beside


def change(editor, text):
    """Writes at the end of the scenario."""
    view = editor.find('new.scn', 'text')
    editor.click(view)
    until(lambda: view.has(12), 'the focus in the scenario')
    editor.keys('ctrl+End')
    editor.type(text.replace('\n', ''))
    editor.keys('Return')
    until(lambda: text in view.text(), 'what is typed')


def tab(screen):
    """closing the tab of a changed scenario asks: cancel, discard, save"""
    editor, path = scenario(screen)
    editor.says('• new.scn')
    editor.keys('ctrl+shift+w')
    editor.answer('Cancel')
    assert editor.all('new.scn', 'text') and read(path) == SCENARIO
    editor.keys('ctrl+shift+w')
    editor.answer('Discard')
    until(lambda: not editor.all('new.scn', 'text'), 'the tab to be gone')
    assert read(path) == SCENARIO
    editor.click(editor.find('new.scn', 'label'), count=2)
    change(editor, '# mine\n')
    editor.keys('ctrl+shift+w')
    editor.answer('Save')
    until(lambda: not editor.all('new.scn', 'text'), 'the tab to be gone')
    assert read(path) == SCENARIO + '# mine\n'


def window(screen):
    """closing the window asks, too: Cancel keeps it, Save writes the scenario and closes it"""
    editor, path = scenario(screen)
    editor.keys('ctrl+w')
    editor.says('new.scn” has changes')
    editor.answer('Cancel')
    assert editor.all('new.scn', 'text') and read(path) == SCENARIO
    editor.keys('ctrl+w')
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the end')
    assert editor.process.returncode == 0 and read(path) == SCENARIO + '# mine\n'


def one_history(screen):
    """Ctrl+Z undoes the last change, on a sheet or in a scenario, and shows it; Ctrl+Y redoes it"""
    editor, path = scenario(screen)
    editor.click(editor.find('Main', 'label'), count=2)
    until(lambda: editor.all('• new.scn'), 'the change of the scenario to be known')
    editor.to_sheet()
    plain = editor.cells()
    editor.keys('slash')
    until(lambda: editor.cells() != plain, 'the negated contact')
    negated = editor.cells()
    editor.keys('ctrl+z')
    until(lambda: editor.cells() == plain, 'the contact as it was')
    assert editor.all('• new.scn')
    editor.keys('ctrl+z')
    editor.says('Undone: Change new.scn')
    view = editor.find('new.scn', 'text')
    until(lambda: view.text() == SCENARIO + '# mine', 'the scenario in front, before the last key')
    editor.shot('files-one-history')
    editor.keys('ctrl+z')
    until(lambda: view.text() == SCENARIO and not editor.all('• new.scn'), 'the scenario as it was saved')
    for _ in range(3):
        editor.keys('ctrl+y')
    until(lambda: editor.cells() == negated, 'all of it again')
    assert read(path) == SCENARIO


def written_over(screen):
    """the scenario changed on disk: the first save is refused with a message, the second writes"""
    editor, path = scenario(screen)
    write(path, SCENARIO + '# theirs\n')
    editor.keys('ctrl+s')
    editor.says('was changed by another program')
    editor.shot('files-somebody-else')
    assert read(path) == SCENARIO + '# theirs\n'
    editor.save(path)
    assert read(path) == SCENARIO + '# mine\n'


def closing(screen):
    """the project changed on disk: saving while closing is refused, too, and the window stays"""
    path = new_file(screen, ONE_RUNG)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash')
    editor.find('•')
    theirs = ONE_RUNG.replace('Start', 'Begin')
    write(path, theirs)
    editor.says('Another program changed the file')
    editor.keys('ctrl+w')
    editor.answer('Save')
    editor.says('Saving would overwrite those changes')
    assert read(path) == theirs
    editor.click(editor.find('Save anyway', 'push button'))
    until(lambda: 'NC Start' in read(path), 'it to be saved all the same')
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=1', 'Motor=0']


one_history.quick = 'editor-gtk/document'
main([refused, classic, plain, no_program, no_text, foreign, beside, stays_a_link, tab, window, one_history, written_over, closing])
