#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# cli - tests the command line from outside: exit status, standard output and standard
# error, bad input, JSON, full disks, closed pipes. Scenarios test what programs do.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Temp qw(tempdir);
use JSON::PP;
use POSIX qw(mkfifo);
use Test::More;
use Time::HiRes qw(sleep time);
use File::Basename qw(dirname);
use lib abs_path(dirname(__FILE__));
use Terminal;

my $ladder = abs_path($ENV{LADDER} // 'build/ladder');
my $root = abs_path('.');
my $dir = tempdir(CLEANUP => 1);
my $diag = qr/^\S.*: (?:error|warning) LD\d{3}: /;
chdir $dir or die;

sub put { my ($name, $text) = @_; open my $f, '>:raw', $name or die; print $f $text; close $f or die }
sub get { my ($name) = @_; open my $f, '<:raw', $name or die; local $/; my $text = <$f>; close $f; $text }

# Root may write everywhere, so the test gives up that right.
my @as_user;
# Returns exit status, standard output, standard error.
sub run {
	my (@args) = @_;
	my $in = ref $args[0] ? ${shift @args} : '';
	put('.in', $in);
	open my $stdin, '<', '.in' or die;
	my $pid = fork // die;
	if (!$pid) {
		open STDIN, '<&', $stdin; open STDOUT, '>', '.out'; open STDERR, '>', '.err';
		exec @as_user, $ladder, @args or die;
	}
	local $SIG{ALRM} = sub { kill 9, $pid };
	alarm 20; waitpid $pid, 0; my $status = $?; alarm 0;
	return ($status & 127 ? "signal $status" : $status >> 8, get('.out'), get('.err'));
}
# Every line on standard error is a diagnostic.
sub pure { my ($err) = @_; !grep { $_ !~ $diag } split /\n/, $err }
sub is_run {
	my ($want, $what, $args, $in) = @_;
	my ($status, $out, $err) = run(defined $in ? \$in : (), @$args);
	is($status, $want, "$what: exit $want") or diag("$out$err");
	ok(pure($err), "$what: only diagnostics on standard error") or diag($err);
	return ($out, $err);
}

put('good.rung', <<'END');
RUNGBOARD 1
PROJECT "Good"

VAR
  Open  AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG Seal "holds itself"
  | NO Open   | NC Stop | COIL Motor |
  | NO Motor ^|
END_PROGRAM
END
(my $ugly = get('good.rung')) =~ s/  \| NO Open   \|/| NO Open|/;
put('ugly.rung', $ugly);
(my $bad = get('good.rung')) =~ s/NC Stop/NC Stopp/;
put('bad.rung', $bad);
(my $other = get('good.rung')) =~ s/NC Stop/NO Stop/;
put('other.rung', $other);
put('broken.rung', "RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NO\n");
put('loop.rung', "RUNGBOARD 1\nPROGRAM Main LD\nRUNG A\n  | NO I0 | JMP A |\nEND_PROGRAM\n");
put('good.script', "\@print Motor\nOpen=1\nOpen=0 x2\nStop=1\n");
put('good.scn', "scenario \"holds\"\n  at 0 Open = 1\n  at 20ms Open = 0\n  at 1s expect Motor\n");
put('map.io', "BOARD \"none\"\n%IX0.0 sim active-low\n%QX0.0 sim\n");

# ---- the program itself ----
my ($out, $err) = is_run(0, '--version', ['--version']);
like($out, qr/^ladder \d+\.\d+\.\d+\n$/, '--version prints it');
($out) = is_run(0, '--help', ['--help']);
my @commands = $out =~ /^  ([a-z]+)  +\S.*$/mg;
is_deeply([sort grep { $_ ne 'help' } @commands],
	  [sort qw(check fmt show il code build run trace test bench words diff io push xref replay why export import board boards)], 'all commands are there');
($out, $err) = is_run(2, 'no command', []);
is($out, '', 'no command: nothing on standard output');
is_run(2, 'unknown command', ['frobnicate']);
for my $command (@commands) {
	my ($help) = is_run(0, "$command --help", [$command, '--help']);
	like($help, qr/^Usage: ladder $command /, "$command --help: usage");
	like($help, qr/^Example:\n  .*ladder \Q$command\E/m, "$command --help: an example of it");
	my ($same) = is_run(0, "help $command", ['help', $command]);
	is($same, $help, "help $command prints the same");
	my ($man) = is_run(0, "man page of $command", ['help', '--man', $command]);
	like($man, qr/^\.TH "LADDER-\U$command\E" 1 /, "man page of $command has a title");
	is_run(2, "$command --nonsense", [$command, '--nonsense']);
	if ($command !~ /^(?:words|io|help)$/) {
		($out, $err) = is_run(2, "$command without a file", [$command]);
		is($out, '', "$command without a file: no result");
	}
}
is_run(2, 'too many arguments', ['il', 'good.rung', 'good.rung']);
is_run(2, 'an option without its value', ['trace', 'good.rung', 'good.script', '--period']);
is_run(2, 'a value for an option without', ['check', '--json=1', 'good.rung']);
put('--json', $bad);
is_run(1, 'a name like an option, behind --', ['check', '--', '--json']);

# ---- bad input, for every command that reads a program ----
my %inputs = (
	empty => '', nul => "RUNGBOARD 1\n\0\0", binary => join('', map { chr($_ * 7 % 256) } 1 .. 4096),
	half => substr(get('good.rung'), 0, 150), utf8 => "RUNGBOARD 1\nPROJECT \"\xff\xfe\"\n",
	newer => "RUNGBOARD 99\n", long => 'a' x 1_000_000, bars => "RUNGBOARD 1\nPROGRAM M LD\nRUNG\n" . ('|' x 100_000),
	name => "RUNGBOARD 1\nVAR\n  " . ('n' x 10_000) . " : BOOL;\nEND_VAR\n", range => "RUNGBOARD 1\nVAR\n A : INT := 99999999999999999999;\nEND_VAR\n",
	code => "RUNGCODE" . ("\xff" x 200),
);
# An alarm whose text is too long, in each way to write it.
my $long_text = "'" . ('x' x 10_000) . "'";
my $alarm = "RUNGBOARD 1\nVAR\n  A : ALARM;\nEND_VAR\n";
$inputs{alarm} = "${alarm}PROGRAM M LD\nRUNG\n  | NO I0 | ALARM A MSG:=$long_text |\nEND_PROGRAM\n";
$inputs{alarm_st} = "${alarm}PROGRAM M ST\nA(MSG := $long_text);\nEND_PROGRAM\n";
for my $name (qw(alarm alarm_st)) {
	put("in-$name", $inputs{$name});
	like((is_run(1, "$name: refused", ['check', "in-$name"]))[1], qr/: error LD116: "'x+": constant is out of range/, "$name: too long");
}
my %with = (trace => ['good.script'], build => ['-o', 'out.rungc'], diff => ['good.rung'], run => ['--scans', '1']);
for my $name (sort keys %inputs) {
	put("in-$name", $inputs{$name});
	for my $command (qw(check fmt show il code build run trace bench diff)) {
		next if $command ne 'check' && $name =~ /^(?:long|bars|binary|name)$/;
		my ($status, $out, $err) = run($command, "in-$name", @{$with{$command} || []});
		ok($status eq ($command eq 'diff' ? 2 : 1), "$command of $name: refused") or diag("$status: $err");
		ok($err =~ /error LD\d{3}/ && pure($err), "$command of $name: says why") or diag($err);
	}
	is(get("in-$name"), $inputs{$name}, "$name: unchanged");
}
ok(!-e 'out.rungc', 'no image was built of bad input');
for my $path ('nothing-here.rung', '.') {
	for my $command (qw(check fmt show il code run bench)) {
		my ($out, $err) = is_run(2, "$command $path", [$command, $path, @{$with{$command} || []}]);
		like($err, qr/^\Q$path\E: error LD0(?:0|33)/, "$command $path: says so");
		unlike($out, qr/good/, "$command $path: no result");
	}
}
put('crlf.rung', get('good.rung') =~ s/\n/\r\n/gr);
is_run(0, 'CRLF', ['check', 'crlf.rung']);

# ---- check ----
($out, $err) = is_run(0, 'check', ['check', 'good.rung']);
is($out, "good.rung: good\n", 'check: the last line');
($out, $err) = is_run(1, 'check of an error', ['check', 'good.rung', 'bad.rung']);
like($err, qr/^bad\.rung:\d+: rung 1 \(1,2\): error LD301: "Stopp" .*; did you mean Stop\?$/m, 'check: file, line, rung, cell, code, name');
like($out, qr/^good\.rung: good\nbad\.rung: 1 error/, 'check: a line for each file');
($out, $err) = is_run(1, 'check --json', ['check', '--json', 'good.rung', 'bad.rung']);
my $json = decode_json($out);
is($err, '', 'check --json: nothing on standard error');
ok($json->[0]{good} && !@{$json->[0]{diagnostics}}, 'check --json: the good file');
my ($first) = grep { $_->{severity} eq 'error' } @{$json->[1]{diagnostics}};
is_deeply([@$first{qw(code file rung row col)}], ['LD301', 'bad.rung', 1, 1, 2], 'check --json: the place');
is($first->{arg}, 'Stopp', 'check --json: the name alone');
is($first->{text}, '"Stopp" is not declared; did you mean Stop?', 'check --json: the whole sentence');
my $said = (run('check', 'bad.rung'))[2];
is(scalar(grep { index($said, " $_->{code}: $_->{text}\n") < 0 } @{$json->[1]{diagnostics}}), 0, 'check --json: the sentences of check');
($out) = is_run(1, 'check --json of all golden cases', ['check', '--json', sort glob("$root/tests/golden/*/main.rung")]);
unlike($out, qr/[\x00-\x09\x0b-\x1f\x7f]|\\u00[01]/, 'check --json: no control character');
cmp_ok(scalar(grep { defined $_->{arg} } map { @{$_->{diagnostics}} } @{decode_json($out)}), '>', 100, 'check --json: the names of many messages');
($out) = is_run(0, 'check --tasks', ['check', '--tasks', 'good.rung']);
like($out, qr/^good\.rung: good\n  task .*\n  - +in every cycle +- +\d+ +-\n  cycles every 10 ms, \d+ words a millisecond are enough\n$/, 'check --tasks: one task');
put('hasty.rung', "RUNGBOARD 1\nCONFIGURATION P\n  TASK T (INTERVAL := T#100us, PRIORITY := 1);\n  PROGRAM A WITH T : Main;\nEND_CONFIGURATION\n"
    . "PROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nEND_PROGRAM\n");
($out) = is_run(1, 'check --speed', ['check', '--json', '--speed', '1', 'hasty.rung']);
$json = decode_json($out)->[0];
ok($json->{good} && !$json->{fast_enough} && $json->{enough} > 1 && $json->{tasks}[0]{left_out}, 'check --speed: too slow');
($out) = is_run(1, 'check --tasks of tasks that cannot meet their periods', ['check', '--tasks', '--speed', '1', 'hasty.rung']);
like($out, qr/^  T +every 0\.1 ms .* \d+\n.*^  too slow: tasks leave out periods; (\d+) words a millisecond are enough\n/ms, 'check --tasks: with the figures');
($out) = is_run(0, 'check --tasks with the speed that it names', ['check', '--tasks', '--speed', $out =~ /(\d+) words a millisecond/, 'hasty.rung']);
is_run(2, 'check --speed 0', ['check', '--speed', '0', 'good.rung']);
($out) = is_run(2, 'check --json of no file', ['check', '--json', 'nowhere']);
is(decode_json($out)->[0]{diagnostics}[0]{code}, 'LD002', 'check --json: no file');
put(qq(we"ird\n\x01.rung), $bad);
(undef, $out) = run('check', '--json', qq(we"ird\n\x01.rung));
ok(eval { decode_json($out) }, 'check --json of a weird name') or diag($@);

# ---- fmt ----

put('words.st', "PROGRAM Main\nVAR\n  By : INT;\n  to : INT;\n  Do : INT;\n  Not_ : BOOL;\nEND_VAR\n  By:=2;to:=by+1;\n"
	. "  for Do:=to to 3 by by do to:=by mod -do; exit; end_for;\n"
	. "  if not not_ and_then true or to=-by then do:=do mod 2; end_if;\n  case to of by+0: to:=1; else return; end_case;\nEND_PROGRAM\n");
is_run(0, 'fmt of Structured Text', ['fmt', 'words.st']);
like(get('words.st'), qr/\n  By := 2;\n  to := by \+ 1;\n  FOR Do := to TO 3 BY by DO\n    to := by MOD -do;\n    EXIT;\n  END_FOR;\n/,
	'words of the language are in capitals, variables called like them are not');
like(get('words.st'), qr/\n  IF NOT not_ AND_THEN TRUE OR to = -by THEN\n    do := do MOD 2;\n  END_IF;\n  CASE to OF\n    by \+ 0:\n/,
	'operators are, too, and not what stands in the place of an operand');
my $canonical = get('good.rung');
($out) = is_run(1, 'fmt --check', ['fmt', '--check', 'good.rung', 'ugly.rung']);
is($out, "ugly.rung\n", 'fmt --check names the file');
is(get('ugly.rung'), $ugly, 'fmt --check changes nothing');
chmod 0640, 'ugly.rung';
($out) = is_run(0, 'fmt', ['fmt', 'good.rung', 'ugly.rung']);
is($out, '', 'fmt is silent');
is(get('ugly.rung'), $canonical, 'fmt makes it canonical');
is((stat 'ugly.rung')[2] & 0777, 0640, 'fmt keeps the mode');
is_run(0, 'fmt --check afterwards', ['fmt', '--check', 'ugly.rung']);
my $mtime = (stat 'good.rung')[9];
utime 1, 1, 'good.rung';
is_run(0, 'fmt of a canonical file', ['fmt', 'good.rung']);
is((stat 'good.rung')[9], 1, 'fmt does not touch a canonical file');
is_run(1, 'fmt of an error', ['fmt', 'broken.rung']);
SKIP: {
	my $setpriv = grep { -x "$_/setpriv" } split /:/, $ENV{PATH};
	skip 'root may write everywhere, and no setpriv(1)', 3 if $> == 0 && !$setpriv;
	@as_user = ('setpriv', '--bounding-set=-dac_override,-dac_read_search') if $> == 0;
	mkdir 'ro'; put('ro/ugly.rung', $ugly); chmod 0555, 'ro';
	is_run(2, 'fmt in a read-only folder', ['fmt', 'ro/ugly.rung']);
	is(get('ro/ugly.rung'), $ugly, 'the file is unchanged');
	@as_user = ();
	chmod 0755, 'ro';
}

# ---- show, il, code, build, diff, words ----
($out) = is_run(0, 'show', ['show', 'good.rung']);
like($out, qr/Open.*Stop.*Motor/s, 'show draws the rung');
is_run(0, 'show of a label', ['show', 'good.rung', 'Seal']);
is_run(0, 'show of POU:NUMBER', ['show', 'good.rung', 'Main:1']);
($out) = is_run(2, 'show of no rung', ['show', 'good.rung', '7']);
is($out, '', 'show of no rung: nothing');
put('networks.rung', <<'END');
RUNGBOARD 1

PROGRAM Main FBD
VAR
  A : BOOL;
  Q : BOOL;
  R : BOOL;
END_VAR
NETWORK
  Q := NOT A
NETWORK Second
  R := Q AND A
END_PROGRAM
END
($out) = is_run(0, 'show of the label of a network', ['show', 'networks.rung', 'Second']);
like($out, qr/^2  Second\n.*AND.*\[ R \]/s, 'draws that network');
unlike($out, qr/\[ Q \]/, 'and no other');
($out) = is_run(0, 'show of the number of a network', ['show', 'networks.rung', 'Main:1']);
like($out, qr/^1\n *A ?o\[ Q \]/, 'draws that one');
is_run(2, 'show of no network', ['show', 'networks.rung', 'Main:3']);
($out) = is_run(0, 'show --ascii', ['show', '--ascii', 'good.rung']);
unlike($out, qr/[^\x00-\x7f]/, 'show --ascii is ASCII');
($out) = is_run(0, 'il', ['il', 'good.rung']);
put('il.rung', $out);
like($out, qr/^RUNGBOARD 1\n.*^PROGRAM Main IL\n.*^  LD +Open\n.*^END_PROGRAM\n\z/ms, 'il is a whole file');
is_run(0, 'check of the il', ['check', 'il.rung']);
($out) = is_run(0, 'code', ['code', 'good.rung']);
like($out, qr/^stretches +1, left out when .*\n +0\.\.\d+\n +reads  [\d. ]+\n +writes [\d. ]+\n/m, 'code tells what a scan may leave out');
like($out, qr/^identity +[0-9a-f]{64}\n.*worst case +[1-9]/ms, 'code: identity and worst case');
my ($identity) = $out =~ /^identity +(\w+)/;
($out) = is_run(0, 'code of the il', ['code', 'il.rung']);
like($out, qr/^identity +$identity$/m, 'the il gives the same code');
($out) = is_run(0, 'code of a loop', ['code', 'loop.rung']);
like($out, qr/loops/, 'code: reports a loop');
is_run(0, 'build', ['build', 'good.rung', '-o', 'good.rungc']);
($out) = is_run(0, 'code of the image', ['code', 'good.rungc']);
like($out, qr/^identity +$identity$/m, 'the image has the same identity');
($out) = is_run(0, 'trace of the image', ['trace', 'good.rungc', 'good.script']);
my ($direct) = is_run(0, 'trace', ['trace', 'good.rung', 'good.script']);
my ($whole) = is_run(0, 'trace --full-scan', ['trace', '--full-scan', 'good.rung', 'good.script']);
is($whole, $direct, 'trace --full-scan prints the same');
is_run(0, 'run --full-scan', ['run', '--full-scan', 'good.rung', '--scans', '3']);
is($out, $direct, 'the image does the same');
($out) = is_run(0, 'il of an image', ['il', 'good.rungc']);
put('image.rung', $out);
is_run(0, 'check of the il of an image', ['check', 'image.rung']);
is_run(1, 'show of an image', ['show', 'good.rungc']);
is_run(1, 'fmt of an image', ['fmt', 'good.rungc']);
is_run(0, 'build --small', ['build', '--small', 'good.rung', '-o', 'small.rungc']);
($out) = is_run(0, 'diff of an image and its small one', ['diff', 'good.rungc', 'small.rungc']);
is($out, '', 'diff of an image and its small one: nothing');
is_run(0, 'diff of a program and its image', ['diff', 'good.rung', 'good.rungc']);
($out) = is_run(1, 'diff of a program and an image of another', ['diff', 'other.rung', 'good.rungc']);
is($out, "the code images differ\n", 'diff of a program and an image of another');
is_run(2, 'build without -o', ['build', 'good.rung']);
is_run(2, 'build into no folder', ['build', 'good.rung', '-o', 'nowhere/good.rungc']);
my $image = get('good.rungc');
for my $at (0, 9, 13, 17, 60, 200, length($image) - 1) {
	put('damaged.rungc', substr($image, 0, $at) . chr(ord(substr $image, $at, 1) ^ 0x55) . substr($image, $at + 1));
	is_run(1, "image damaged at $at", ['code', 'damaged.rungc']);
}
put('cut.rungc', substr($image, 0, 100));
is_run(1, 'image cut', ['run', 'cut.rungc', '--scans', '1']);
($out) = is_run(0, 'diff of the same', ['diff', 'good.rung', 'good.rung']);
is($out, '', 'diff of the same: nothing');
($out) = is_run(1, 'diff', ['diff', 'good.rung', 'other.rung']);
like($out, qr/Stop/, 'diff names it');
($out) = is_run(1, 'diff --json', ['diff', '--json', 'good.rung', 'other.rung']);
is(scalar @{decode_json($out)}, 1, 'diff --json: one difference');
($out) = is_run(0, 'diff --json of the same', ['diff', '--json', 'good.rung', 'good.rung']);
is(scalar @{decode_json($out)}, 0, 'diff --json of the same: none');
is_run(2, 'diff with an error', ['diff', 'good.rung', 'broken.rung']);
($out) = is_run(0, 'words', ['words', 'ton']);
like($out, qr/TON.*\bPT\b.*\bET\b/s, 'words: the pins');
like($out, qr/table 46.*TON Box PT:=T#2s.*TON .*CAL +Box\(/s, 'words: source, example, picture, list');
($out) = is_run(0, 'words --json of one', ['words', '--json', 'ton']);
like(decode_json($out)->[0]{$_}, qr/TON|CAL|IEC/, "words --json: $_") for qw(source example picture list);
($out) = is_run(0, 'complete', ['complete', 'good.rung', '1', '1']);
is((is_run(2, 'complete nowhere', ['complete', 'good.rung', '9999', '1']))[1],
   "good.rung: error LD071: the file has no line 9999 with a column 1\n", 'the file is named, not the usage');
is_run(2, 'complete without a number', ['complete', 'good.rung', 'one', '1']);
is_run(2, 'complete of no file', ['complete', 'nowhere.rung', '1', '1']);
($out) = is_run(0, 'complete --json', ['complete', '--json', 'good.rung', '1', '1']);
like($out, qr/^\[/, 'is a list');
($out) = is_run(1, 'words of none', ['words', 'nonsense']);
is($out, '', 'words of none: nothing');
($out) = is_run(0, 'words --json', ['words', '--json']);
ok(decode_json($out), 'words --json is JSON');

# ---- xref ----
($out) = is_run(0, 'xref', ['xref', 'good.rung']);
is(scalar(() = $out =~ /^\S+\t[a-z ]+\tgood\.rung:\d+(?:\t.+)?$/mg), scalar(() = $out =~ /\n/g), 'xref: a place a line');
($out) = is_run(0, 'xref of a name', ['xref', 'good.rung', 'motor']);
is($out, "Motor\tdeclared\tgood.rung:7\nMotor\tcoil\tgood.rung:12\tMain rung 1 (1,3)\nMotor\tread\tgood.rung:13\tMain rung 1 (2,1)\n", 'xref of a name: where and how');
my ($touching) = is_run(0, 'xref of an address', ['xref', 'good.rung', '%QB0']);
is($touching, $out, 'xref of an address: what shares a bit with it');
($out) = is_run(0, 'xref of what is wrong', ['xref', 'bad.rung', 'Stopp']);
like($out, qr/^Stopp\tunknown\tbad\.rung:12\t/, 'xref: an unknown name has its place');
($out) = is_run(0, 'xref --json', ['xref', '--json', 'good.rung', 'Seal']);
is_deeply(decode_json($out), [{ name => 'Main:Seal', what => 'label', use => 'declared', file => 'good.rung', line => 11,
	pou => 'Main', rung => 1, row => 0, column => 0, address => undef, off => JSON::PP::false }], 'xref --json: a label');
is_run(1, 'xref of nobody', ['xref', 'good.rung', 'Nobody']);
is_run(1, 'xref of what cannot be read', ['xref', 'broken.rung']);
is_run(2, 'xref of no file', ['xref', 'nowhere.rung']);

# ---- trace ----
is($direct, "1 t=10 Motor=1\n2 t=20 Motor=1\n3 t=30 Motor=1\n4 t=40 Motor=0\n", 'trace');
($out) = is_run(0, 'trace of standard input', ['trace', 'good.rung', '-', '--changes', '--period', '2.5'], "\@print Motor\n.\nOpen=1\n.\n");
is($out, "2 t=5 Motor=1\n", 'trace --changes --period');
($out) = is_run(0, 'trace --csv', ['trace', 'good.rung', 'good.script', '--csv']);
like($out, qr/^scan,t_ms,Motor\r\n1,10,1\r\n/, 'trace --csv');
($out) = is_run(0, 'trace --vcd', ['trace', 'good.rung', 'good.script', '--vcd']);
like($out, qr/^\$timescale 1ns \$end\n.*^\$enddefinitions \$end\n.*^#10000000\n1!\n/ms, 'trace --vcd');
is_run(2, 'trace --csv --vcd', ['trace', 'good.rung', 'good.script', '--csv', '--vcd']);
($out, $err) = is_run(1, 'trace of a bad script', ['trace', 'good.rung', '-'], "Open=1\nOpen=5\n");
is($out, '', 'a bad script is not begun');
like($err, qr/^-:2:6: error LD116: /, 'a bad script: line and code');
($out, $err) = is_run(1, 'trace of a loop', ['trace', 'loop.rung', '-'], "\@print %I0\n.\n%I0=1\n");
like($err, qr/^-:3: .*error LD008: .*budget/, 'trace of a loop: the fault');
is_run(2, 'trace without a script', ['trace', 'good.rung', 'nothing']);

# ---- test ----
($out, $err) = is_run(0, 'test', ['test', 'good.scn']);
is($out, "ok 1 - good.scn: holds\n1..1\n", 'test prints TAP');
($out) = is_run(0, 'test of a program', ['test', 'good.rung']);
is($out, "ok 1 - good.scn: holds\n1..1\n", 'test of a program');
mkdir 'sub'; mkdir 'sub/below';
put('sub/good.rung', $canonical); put('sub/below/a.rung', $canonical);
put('sub/good.scn', "scenario \"a # b\"\nat 20ms expect Motor\n"); put('sub/below/a.scn', get('good.scn'));
($out) = is_run(1, 'test of a folder', ['test', 'sub']);
like($out, qr/^ok 1 - sub\/below\/a\.scn: holds\nnot ok 2 - sub\/good\.scn: a \\# b\n# sub\/good\.scn:2: at 20 ms: .*\n#   1 t=10 Motor=0\n#   2 t=20 Motor=0\n1\.\.2\n\z/, 'test of a folder');
($out) = is_run(1, 'test of an image', ['test', 'sub/good.scn', 'good.scn']);
like($out, qr/^not ok 1 .*^ok 2 /ms, 'test continues after a failure');
put('alone.scn', get('good.scn'));
put('two.rung', get('good.rung'));
put('two.scn', "scenario \"good\"\n  at 1s expect not Motor\nscenario \"wrong\"\n  at 1s expect Motor\nscenario \"after\"\n  at 1s expect not Motor\n");
($out) = is_run(1, 'all scenarios', ['test', 'two.scn', 'good.scn']);
like($out, qr/^not ok 2 .*^ok 3 .*^ok 4 .*^1\.\.4$/ms, 'a failed scenario does not end a test');
($out) = is_run(1, 'fail-fast', ['test', '--fail-fast', 'two.scn', 'good.scn']);
like($out, qr/^ok 1 .*^not ok 2 .*^1\.\.2$/ms, 'with --fail-fast it does');
unlike($out, qr/^ok 3/m, 'and no other runs');
($out) = is_run(1, 'scenarios without a program', ['test', 'alone.scn']);
like($out, qr/^not ok 1 - alone\.scn: its program is good\n1\.\.1\n/, 'scenarios without a program fail');
is_run(2, 'test of nothing', ['test', 'nowhere']);
is_run(2, 'a program without scenarios', ['test', 'bad.rung']);
mkdir 'empty';
is_run(2, 'a folder without scenarios', ['test', 'empty']);
put('wrong.rung', $canonical); put('wrong.scn', "scenario \"x\"\nexpect Nothing\n");
($out, $err) = is_run(1, 'a wrong scenario', ['test', 'wrong.scn']);
like($err, qr/^wrong\.scn:2:8: error LD301: .*Nothing/, 'a wrong scenario: place and name');

my $locals = "VAR\n  X : BOOL;\n  T : TON;\nEND_VAR\nRUNG\n  | NO I0 | TON T PT:=T#0s | COIL X |\nRUNG\n  | NO X | COIL";
put('locals.rung', "RUNGBOARD 1\nPROGRAM A LD\n$locals Q0 |\nEND_PROGRAM\nPROGRAM B LD\n$locals Q1 |\nEND_PROGRAM\n");
put('locals.scn', "scenario \"x\"\nat 0ms I0 = 1\nexpect A.X and b.t.q\n");
is_run(0, 'a local with its program', ['test', 'locals.scn']);
put('locals.scn', "scenario \"x\"\nat 0ms X = 1\nexpect T.Q\n");
($out, $err) = is_run(1, 'a local of which program', ['test', 'locals.scn']);
like($err, qr/^locals\.scn:2:8: error LD327: "X" .*\n.*:3:8: error LD327: "T\.Q" .*$/m, 'a local of which program: place and name');
($out, $err) = is_run(1, 'trace: of which program', ['trace', 'locals.rung', '-'], "\@print A.X X\nT.PT=5\n");
is(() = $err =~ /error LD327/g, 2, 'trace: of which program');
is_run(2, 'run: of which program', ['run', 'locals.rung', '--set', 'X=1', '--scans', '1']);

# ---- the examples of --help name files that exist ----
for my $name (qw(check fmt show il code build run trace test bench words diff io push board)) {
	($out) = is_run(0, "$name --help", [$name, '--help']);
	is_deeply([grep { !-e "$root/$_" } $out =~ m{\b(ladders/[\w./-]*)}g], [], "$name --help: files of the example");
}

# ---- bench, io ----
($out) = is_run(0, 'bench', ['bench', 'good.rung', '--scans', '60']);
like($out, qr/^rungs +1\n.*^body, zero +\d/ms, 'bench prints a table');
($out) = is_run(0, 'bench --json', ['bench', 'good.rung', '--scans', '60', '--json']);
$json = decode_json($out);
ok($json->{$_}{min} <= $json->{$_}{median} && $json->{$_}{median} <= $json->{$_}{max}, "bench --json: $_")
	for map { ("body_${_}_ns", "scan_${_}_ns") } qw(zero fixed random paced);
is_run(2, "bench --scans $_", ['bench', 'good.rung', '--scans', $_]) for '0', '-1', 'x', '5x', '99999999999999999999';
($out) = is_run(0, 'io of a map', ['io', 'map.io']);
like($out, qr/^%IX0\.0 .*good\n%QX0\.0 .*good\n\z/m, 'io of a map: its lines');
($out) = is_run(0, 'io --json', ['io', '--json', 'map.io']);
is(decode_json($out)->{points}[0]{address}, '%IX0.0', 'io --json');
put('bad.io', "BOARD \"x\"\n%IX0.0 nonsense\n");
($out, $err) = is_run(1, 'io of a bad map', ['io', 'bad.io']);
like($err, qr/^bad\.io:2:8: error LD503: /, 'io of a bad map: place');
is_run(2, 'io of no map', ['io', 'nowhere.io']);
my ($listed, $lines) = run('io', '--json');
ok($listed =~ /^[01]$/ && decode_json($lines), 'io --json lists this machine');

# ---- run ----
($out) = is_run(0, 'run', ['run', 'good.rung', '--scans', '3', '--period', '1ms', '--set', 'I0=1']);
is($out, "1 t=1 Open=1 Motor=1\n", 'run in a pipe: a line for every change');
($out) = is_run(0, 'run --speed', ['run', 'good.rung', '--scans', '100', '--speed', '1000', '--set', 'Open=1', '--set=Stop=1']);
is($out, "1 t=10 Open=1 Stop=1\n", 'run --speed: program time is the same');
($out) = is_run(0, 'run --io', ['run', 'good.rung', '--io', 'map.io', '--scans', '2', '--period', '1ms', '--set', 'Open=1']);
is($out, "1 t=1 Open=1 Motor=1\n", 'run --io: switches are not inverted twice');
is_run(2, "run $_->[0] $_->[1]", ['run', 'good.rung', @$_, '--scans', '1'])
	for ['--period', '0'], ['--period', '5parsec'], ['--speed', '0'], ['--speed', 'x'], ['--speed', 'nan'], ['--set', 'Nothing=1'],
	    ['--set', 'Open'], ['--set', 'Open=7'];
is_run(2, 'run --scans 0', ['run', 'good.rung', '--scans', '0']);
is_run(2, 'run with no map', ['run', 'good.rung', '--io', 'nowhere', '--scans', '1']);
is_run(1, 'run with a bad map', ['run', 'good.rung', '--io', 'bad.io', '--scans', '1']);
put('far.io', "BOARD \"x\"\n%IX0.0 sim\n%IX512.0 sim\n");
(undef, $err) = is_run(1, 'run with a line beyond its area', ['run', 'good.rung', '--io', 'far.io', '--scans', '1']);
like($err, qr/^far\.io:3:1: error LD523: "%IX512\.0" /m, 'run: the line and its place');
(undef, $err) = is_run(1, 'io --program with such a line', ['io', 'far.io', '--program', 'good.rung']);
like($err, qr/^far\.io:3:1: error LD523: /m, 'io --program: the line and its place');
is_run(0, 'io without a program checks no sizes', ['io', 'far.io']);
($out) = is_run(0, 'code of a program without AREA', ['code', 'good.rung']);
like($out, qr/^areas         20160 bytes: I 512 Q 512 M 8192 V 8192 /m, 'code: the default sizes');
($out, $err) = is_run(1, 'run of a loop', ['run', 'loop.rung', '--set', 'I0=1', '--scans', '5']);
like($err, qr/LD008/, 'run of a loop: the fault');
for my $signal (qw(INT TERM)) {
	put('.out', '');
	my $pid = fork // die;
	if (!$pid) { open STDOUT, '>', '.out'; open STDIN, '<', '/dev/null'; exec $ladder, 'run', 'good.rung', '--set', 'Open=1' or die }
	for (1 .. 500) { sleep 0.02; last if -s '.out' }
	kill $signal, $pid; waitpid $pid, 0;
	is($?, 0, "run ends well with SIG$signal");
	is(get('.out'), "1 t=10 Open=1 Motor=1\n", "SIG$signal: the lines are there");
}

# ---- a result that cannot be written ----
SKIP: {
	skip 'no /dev/full', 1 if !-c '/dev/full';
	for my $args (['--help'], ['check', 'good.rung'], ['show', 'good.rung'], ['il', 'good.rung'], ['code', 'good.rung'], ['words'],
		      ['trace', 'good.rung', 'good.script'], ['test', 'good.scn'], ['run', 'good.rung', '--set', 'Open=1', '--scans', '3']) {
		my $pid = fork // die;
		if (!$pid) { open STDOUT, '>', '/dev/full'; open STDERR, '>', '.err'; exec $ladder, @$args or die }
		waitpid $pid, 0;
		is($? >> 8, 2, "@$args on a full disk: exit 2");
		like(get('.err'), qr/^standard output: error LD006: .*No space/, "@$args on a full disk: says so");
	}
}
# Like a full disk: no file may grow. The old file must be unchanged.
put('old.rungc', 'old'); put('ugly.rung', $ugly);
for my $args (['build', 'good.rung', '-o', 'old.rungc'], ['fmt', 'ugly.rung']) {
	my $what = "$args->[0] on a full disk";
	my $status = system 'sh', '-c', "trap '' XFSZ; ulimit -f 0; exec \Q$ladder\E @$args 2>/dev/null";
	is($status >> 8, 2, "$what: exit 2");
}
is(get('old.rungc'), 'old', 'build on a full disk: the old file is intact');
is(get('ugly.rung'), $ugly, 'fmt on a full disk: the old file is intact');
ok(!(grep { /^(?:old|ugly)\.rungc?\../ } glob '*'), 'no temporary file is left behind');
is_run(2, 'build over a folder', ['build', 'good.rung', '-o', 'sub']);
mkfifo('pipe', 0600);
is_run(2, 'build over a pipe', ['build', 'good.rung', '-o', 'pipe']);
ok(-p 'pipe', 'build does not replace a pipe');
for my $args ([qw(words)], ['trace', 'good.rung', '-']) {
	put('many', ". x100000\n");
	pipe my $read, my $write or die;
	close $read; # before the program starts, because it may end at once
	my $pid = fork // die;
	if (!$pid) { open STDIN, '<', 'many'; open STDOUT, '>&', $write; open STDERR, '>', '.err'; close $write; exec $ladder, @$args or die }
	close $write;
	waitpid $pid, 0;
	is($?, 2 << 8, "$args->[0] into a closed pipe: exit 2, no signal");
	like(get('.err'), qr/^standard output: error LD006: .*\n\z/, "$args->[0] into a closed pipe: says so once");
}

# ---- sizes, which do not depend on the machine ----
sub load_of { my ($kind, $n) = @_; put('big.rung', scalar `perl \Q$root\E/tests/bench/programs.pl $kind $n`); run('bench', '--json', '--scans', 1, 'big.rung') }
put('seal.rung', scalar `perl \Q$root\E/tests/bench/programs.pl seal 1000`);
run('build', 'seal.rung', '-o', 'seal.rungc');
cmp_ok(-s 'seal.rungc', '<=', 64 * 1000, 'a seal-in rung takes at most 64 bytes of the image, names included');
run('build', '--small', 'seal.rung', '-o', 'seal.rungc');
cmp_ok(-s 'seal.rungc', '<=', 17 * 1000, 'and 17 without them');
for my $kind (qw(seal mixed)) {
	my (undef, $out) = load_of($kind, 10000);
	cmp_ok(decode_json($out)->{load_bytes}, '<=', 52e6, "10,000 $kind rungs load in 52 MB");
}
for my $kind (qw(lines blocks parts)) { # in one program, in 100 blocks, in 1,000
	my (undef, $out) = load_of($kind, 10000);
	cmp_ok(decode_json($out)->{load_bytes}, '<=', 60e6, "10,000 lines of Structured Text, $kind, load in 60 MB");
}

# ---- the live view when a program stops with a fault ----
SKIP: {
	skip 'no script(1) to make a terminal', 3 unless has_terminal();
	my $moving = 'AVeryLongNameForAMotorInTheBasement';
	put('loop.rung', "RUNGBOARD 1\nVAR\n  $moving : BOOL;\nEND_VAR\nPROGRAM Main LD\nRUNG L\n  | NO I0 | S Q0 |\n  |      ^| S $moving |\nRUNG\n  | NO I0 | JMP L |\nEND_PROGRAM\n");
	put('loop.io', "BOARD \"x\"\n%IX0.0 sim\n%QX0.0 sim safe=0\n%QX0.1 sim safe=1\n");
	my ($ended, $screen) = on_terminal(20, 60, "\Q$ladder\E run loop.rung --io loop.io --set I0=1",
		qr/FAULT: instruction budget.*\* 1 %QX0\.1/s => 'q');
	like($screen, qr/FAULT: instruction budget/, 'live: a fault is shown');
	like($screen, qr/o 0 %QX0\.0.*\* 1 %QX0\.1/s, 'live: in a fault outputs have their safe values');
	like($screen, qr/ AVeryLong\w+ = 1/, 'live: a long name leaves room for the value');
}
# Rungs with their power, also of an instance.
put('own.rung', <<'END');
RUNGBOARD 1
VAR
  A : Seal;
  B : Seal;
END_VAR
FUNCTION_BLOCK Seal LD
VAR_INPUT
  On : BOOL;
END_VAR
VAR_OUTPUT
  Q : BOOL;
END_VAR
RUNG Only
  | NO On | COIL Q |
END_FUNCTION_BLOCK
PROGRAM Main LD
RUNG
  | NO I0 | Seal A |
RUNG Other
  | NO I1 | Seal B |
END_PROGRAM
END
put('own.script', "I0=1\n");
my %powered = (A => '==\| \|=====\( \)=', B => '==\| \|-----\( \)-', 'b:Only' => '==\| \|-----\( \)-',
	'Main.A:1' => '==\| \|=====\( \)=', 'Main:Other' => '==\| \|-----\|On');
for my $name (sort keys %powered) {
	($out, $err) = is_run(0, "show --after: $name", ['show', '--ascii', '--after', 'own.script', 'own.rung', $name]);
	like($out, qr/$powered{$name}/, "show --after: the power of $name");
}
like((is_run(0, 'show --after: all', ['show', '--after', 'own.script', 'own.rung']))[0], qr/━━┤ ├━━/, 'thick wires');
is_run(2, 'show --after: no such instance', ['show', '--after', 'own.script', 'own.rung', 'C']);
is_run(2, 'show of an instance without a script', ['show', 'own.rung', 'A']);
is_run(2, 'show --after: no script', ['show', '--after', 'nowhere', 'own.rung']);
put('bad.script', "Nothing=1\n");
($out, $err) = is_run(1, 'show --after: a wrong script', ['show', '--after', 'bad.script', 'own.rung']);
like($err, qr/^bad\.script:1:1: error LD301/, 'says where');
put('loop.rung', "RUNGBOARD 1\nPROGRAM Main LD\nRUNG L\n  | NO I0 | JMP L |\nEND_PROGRAM\n");
($out, $err) = is_run(1, 'show --after: a fault', ['show', '--ascii', '--after', 'own.script', 'loop.rung']);
like($out, qr/==\| \|==/, 'is drawn as it stopped');
like($err, qr/^own\.script:1: rung 1 \(1,2\): error LD008: .*, in Main$/m, 'with its place');
is_run(2, 'run --rungs: none', ['run', 'own.rung', '--rungs', 'C', '--scans', '1']);
is_run(0, 'run --rungs in a pipe', ['run', 'own.rung', '--rungs', 'A', '--scans', '1']);
SKIP: {
	skip 'no script(1) to make a terminal', 2 unless has_terminal();
	my ($ended, $screen) = on_terminal(20, 60, "\Q$ladder\E run own.rung --rungs Main.B",
		qr/==\| \|-----\( \)-/ => '2', qr/==\| \|=====\( \)=/ => 'q');
	like($screen, qr/FUNCTION_BLOCK Seal as B.*==\| \|-----\( \)-/s, 'live: rungs of an instance');
	like($screen, qr/==\| \|=====\( \)=/, 'live: with their power when an input comes');
}
# ---- a plant beside a program; why ----
put('world.rung', <<'END');
RUNGBOARD 1

VAR
  Motor AT %IX0.0 : BOOL;
  AtEnd AT %QX0.1 : BOOL;
  Way   : DINT;
END_VAR

PROGRAM World LD
RUNG
  | NO Motor | [ Way := Way + 1 ] |
RUNG
  | [ Way >= 3 ] | COIL AtEnd |
END_PROGRAM
END
my ($moved) = is_run(0, 'trace --plant', ['trace', 'good.rung', '-', '--plant', 'world.rung'],
	"\@print Motor Stop plant.Way\nOpen=1 x3\nOpen=0 plant.Way=2\n. x2\n\@reset\n.\n");
is($moved, <<'END', 'trace --plant: the plant runs, and its variables can be shown and set');
1 t=10 Motor=1 Stop=0 plant.Way=0
2 t=20 Motor=1 Stop=0 plant.Way=1
3 t=30 Motor=1 Stop=0 plant.Way=2
4 t=40 Motor=0 Stop=1 plant.Way=3
5 t=50 Motor=0 Stop=1 plant.Way=3
6 t=60 Motor=0 Stop=1 plant.Way=3
7 t=70 Motor=0 Stop=0 plant.Way=0
END
($moved) = is_run(0, 'run --plant', ['run', 'good.rung', '--plant', 'world.rung', '--plain',
	'--set', 'Open=1', '--scans', '6', '--speed', '1000']);
like($moved, qr/^4 .*Stop=1/m, 'it moves there, too');
for my $command (['trace', 'good.rung', '-'], ['run', 'good.rung', '--plain'],
		 ['why', 'good.rung', '-', 'Motor']) {
	my (undef, $said) = is_run(2, "$command->[0]: no such plant", [@$command, '--plant', 'none.rung'], ".\n");
	like($said, qr/^none\.rung: error LD002/m, "$command->[0]: the file");
	like($said, qr/^--plant: error LD016: ".*none\.rung" /m, "$command->[0]: and what it was for");
}
put('broken.plant.rung', "RUNGBOARD 1\nPROGRAM P LD\nRUNG\n  | NO Nobody | COIL %QX0.1 |\nEND_PROGRAM\n");
put('p.rung', get('good.rung'));
sub said_of_scenarios {
	my ($text) = @_;
	put('p.scn', $text);
	my ($status, $out, $err) = run('test', 'p.scn');
	return "$status $err";
}
my $end = "  at 0ms Open = 1\n  at 50ms expect Stop\n";
is(said_of_scenarios("scenario \"a\"\n  plant \"world.rung\"\n$end"), '0 ', 'a plant in a scenario');
is(said_of_scenarios("plant \"world.rung\"\nscenario \"a\"\n$end"), '0 ', 'a plant before all of them');
like(said_of_scenarios("# no plant \"x\" here\nplant \"none.rung\"\nscenario \"a\"\n$end"),
     qr/^1 none\.rung: error LD002.*^p\.scn:2:7: error LD016: .*none\.rung/ms, 'a plant that is not there: the file, and the place');
like(said_of_scenarios("scenario \"a\"\n  plant \"broken.plant.rung\"\n$end"),
     qr/^1 broken\.plant\.rung:4:.*LD301: .*Nobody.*^p\.scn:2:9: error LD016/ms, 'a plant with an error: that, and the place');
like(said_of_scenarios("scenario \"a\"\n  plant \"world.rung\"\n  plant \"world.rung\"\n$end"),
     qr/p\.scn:3:9: error LD134: .*only one plant/, 'two plants');
like(said_of_scenarios("scenario \"a\"\n  plant \"world.rung\"\n$end\nscenario \"b\"\n  plant \"good.rung\"\n$end"),
     qr/p\.scn:7:9: error LD134: .*only one plant/, 'another plant in another scenario');
like(said_of_scenarios("scenario \"a\"\n  at 0ms Open = 1\n  plant \"world.rung\"\n  at 50ms expect Stop\n"),
     qr/p\.scn:3:9: error LD133/, 'a plant behind steps');
like(said_of_scenarios("scenario \"a\"\n$end  expect plant.Way > 1\n"),
     qr/p\.scn:4:10: error LD301: .*plant\.Way/, 'a name of a plant without one');
like(said_of_scenarios("scenario \"a\"\n  plant \"world.rung\"\n$end  expect plant.Nobody > 1\n"),
     qr/p\.scn:5:10: error LD301: .*plant\.Nobody/, 'a plant has no such name');
my ($why) = is_run(0, 'why', ['why', 'good.rung', '-', 'Motor'], "Stop=1\n");
like($why, qr/^Motor has no power: \w+ rung 1 \(1,\d\)\n  .*Open/, 'why: the condition that blocks the power');
like((is_run(2, 'why: no such coil', ['why', 'good.rung', '-', 'Nobody'], ".\n"))[1],
     qr/^good\.rung: error LD070: the program has no coil or rung "Nobody"; `ladder show FILE`/, 'why: where to look');
like((is_run(2, 'import of a rung file', ['import', 'good.rung']))[1], qr/^good\.rung: error LD072: .*folder/,
     'import: what it takes');
is_run(2, 'why: no script', ['why', 'good.rung', 'none.script', 'Motor']);


# ---- plain IEC text ----
mkdir 'iec' or die;
mkdir 'iec/blocks' or die;
put('iec/main.il', <<'END');
PROGRAM Main
VAR Band : Bound; n : INT; END_VAR
  CAL Band(IN := n)
  LD  n
  ADD Step
  ST  n
END_PROGRAM
END
put('iec/blocks/limit.iec', <<'END');
(* a block *)
FUNCTION_BLOCK Bound
VAR_INPUT
  IN : INT;
END_VAR
VAR_OUTPUT
  Q : BOOL;
END_VAR
  LD    IN
  GT    Most
  ST    Q
END_FUNCTION_BLOCK

VAR_GLOBAL CONSTANT
  Most : INT := 3;
  Step : INT := 2;
END_VAR
END
my @parts = ('iec/main.il', 'iec/blocks/limit.iec');
for my $order ([@parts], [reverse @parts], ['iec'], ['iec/blocks', 'iec/main.il']) {
	my $name = join ' ', @$order;
	my ($out) = is_run(0, "check $name", ['check', @$order]);
	is($out, join(', ', @$order) . ": good\n", "$name: one project");
	($out) = is_run(0, "trace $name", ['trace', @$order, '-'], ". x3\n");
	like($out, qr/^3 t=30 Most=3 Step=2 Band\.IN=4 Band\.Q=1 n=6$/m, "$name: every variable by name");
}
is((is_run(1, 'one part alone', ['check', 'iec/main.il']))[1],
   qq{iec/main.il:2:12: error LD118: "Bound" is not a known type\n}, 'one part lacks the other');
($out) = is_run(0, 'xref of a folder', ['xref', 'iec', 'Step']);
is($out, "Step\tdeclared\tiec/blocks/limit.iec:16\nStep\tread\tiec/main.il:5\tMain\n", 'xref names both files');
is_run(0, 'build of a folder', ['build', 'iec', '-o', 'iec.rungc']);
is_run(0, 'show of a folder', ['show', 'iec']);
is_run(0, 'run of a folder', ['run', 'iec', '--scans', '2']);
is_run(0, 'bench of a folder', ['bench', 'iec', '--scans', '5']);
is_run(0, 'code of two files', ['code', @parts]);
is_run(0, 'diff of a folder', ['diff', 'iec', 'iec']);
($out) = is_run(0, 'il of a folder', ['il', 'iec']);
put('iec.rung', $out);
is_run(0, 'il: a rung file', ['check', 'iec.rung']);
is_run(0, 'and the same program', ['diff', 'iec', 'iec.rung']);
($out) = is_run(1, 'fmt --check of a folder', ['fmt', '--check', 'iec']);
is($out, "iec/main.il\n", 'fmt --check names the file that would change');
is_run(0, 'fmt of a folder', ['fmt', 'iec']);
is(get('iec/main.il'), <<'END', 'fmt keeps the form of the file');
PROGRAM Main
VAR
  Band : Bound;
  n    : INT;
END_VAR
  CAL   Band(IN := n)
  LD    n
  ADD   Step
  ST    n
END_PROGRAM
END
put('iec/main.scn', qq{scenario "counts"\n  at 50ms expect n > 5\n});
put('alone.il', "PROGRAM Main\nVAR n : INT; END_VAR\nLD n\nADD 1\nST n\nEND_PROGRAM\n");
put('alone.scn', qq{scenario "counts"\n  at 50ms expect n > 3\n});
($out) = is_run(0, 'test of plain text', ['test', 'alone.scn', 'alone.il']);
like($out, qr/^ok 1 - alone\.scn: counts\nok 2/, 'the scenario finds the program beside it');
for my $text ("\xef\xbb\xbf" . get('alone.il'), get('alone.il') =~ s/\n/\r\n/gr, get('alone.il') =~ s/ /\t/gr) {
	put('other.il', $text);
	is((is_run(0, 'a byte order mark, CR LF, tabs', ['check', 'other.il']))[1], '', 'are nothing to tell');
}
put('wide.il', "\xff\xfe" . join '', map { "$_\0" } split //, get('alone.il'));
like((is_run(1, 'UTF-16', ['check', 'wide.il']))[1], qr/LD142: this is UTF-16 text/, 'UTF-16 is told');
mkdir 'none' or die;
like((is_run(2, 'a folder without a program', ['check', 'none']))[1], qr/^none: error LD033: /, 'is told');
like((is_run(1, 'a rung file among them', ['check', 'iec', 'alone.il', 'iec/main.il']))[1], qr/iec\/main\.il:1: error LD302: /,
     'a name that is declared twice');
put('rung.txt', get('good.rung'));
like((is_run(1, 'a rung file beside others', ['check', 'alone.il', 'rung.txt']))[1], qr/rung\.txt:\d+:\d+: error LD032: /,
     'a rung file is a project of its own');
put('windows.il', get('alone.il') =~ s/PROGRAM/(* \xb0C *)\nPROGRAM/r);
like((is_run(1, 'fmt of Windows-1252', ['fmt', 'windows.il']))[1], qr/^windows\.il: error LD034: /m, 'is not written');
for my $text ("\0" x 10000, "PROGRAM" . "\0" x 10, 'PROGRAM', 'PROGRAM A VAR', "PROGRAM A\n{never closed", 'PROGRAM ' . 'x' x 1_000_000,
              "(*" x 100_000, "<TcPlcObject", "<TcPlcObject>" . "<a>" x 1000, "<TcPlcObject><POU><Declaration><![CDATA[", "<TcPlcObject a='", "(* \@NEST *)\n_LD_BODY",
              "PROGRAM A " x 10_000, "\x1f\x8b\x08", "\x7fELF" . "\xff" x 1_000_000) {
	put('hostile.st', $text);
	is_run(1, 'hostile bytes: ' . (substr($text, 0, 20) =~ s/[^ -~]/?/gr), ['check', 'hostile.st']);
}

chdir '/';
# libmodbus would take 9600 for a speed that serial lines do not have.
SKIP: {
	my $modbus = $ladder =~ s/ladder$/ladder-modbus/r;
	skip 'no ladder-modbus', 2 unless -x $modbus;
	my $said = `$modbus scan --port /dev/none --baud 12345 2>&1`;
	is($? >> 8, 2, 'ladder-modbus: a speed that does not exist');
	like($said, qr/--baud is no option here, or its value is wrong/, 'is told');
}
done_testing();
