#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# pathological - bad input that no person writes: the real programs must end soon, report an
# error with a place, and print nothing to stdout.
#
# BUILD names the folder of the programs.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Temp qw(tempdir);
use IO::Compress::Gzip qw(gzip);
use FindBin;
use POSIX qw(:sys_wait_h);
use lib $FindBin::Bin;
use Files;

my $root = abs_path("$FindBin::Bin/..");
my $build = $ENV{BUILD} || "build";
$build = "$root/$build" unless $build =~ m{^/};
my $ladder = "$build/ladder";
my $daemon = "$build/ladderd";
my $dir = tempdir(CLEANUP => 1);
chdir $dir or die;
my ($n, $failed) = (0, 0);
# A long limit that only a program that hangs reaches.
my $guard = $ENV{GUARD_S} || 60;

sub check {
	my ($good, $text, @why) = @_;

	$n++;
	print $good ? "" : "not ", "ok $n - $text\n";
	return if $good;
	$failed = 1;
	print map { "#   $_\n" } map { split /\n/ } @why;
}

sub read_file { return slurp(@_) // '' }

# Exit status (or "signal N", "hangs"), stdout, stderr.
sub run {
	my ($stdout, @command) = @_;
	my $pid = fork;

	die unless defined $pid;
	if (!$pid) {
		open STDIN, '<', '/dev/null';
		open STDOUT, '>', $stdout || 'out' or POSIX::_exit(126);
		open STDERR, '>', 'err' or POSIX::_exit(126);
		exec { $command[0] } @command or POSIX::_exit(127);
	}
	my $end = time + $guard;
	my $slept = 0.002;
	while (waitpid($pid, WNOHANG) == 0) {
		if (time > $end) {
			kill 'KILL', $pid;
			waitpid $pid, 0;
			return ("hangs", "", read_file('err'));
		}
		select undef, undef, undef, $slept;
		$slept *= 2 if $slept < 0.05;
	}
	my $status = $? & 127 ? "signal " . ($? & 127) : $? >> 8;
	return ($status, $stdout ? "" : read_file('out'), read_file('err'));
}

# Runs it and checks everything that a refusal needs.
sub refused {
	my ($text, $want, $name, @command) = @_;
	my ($status, $out, $err) = run(undef, @command);
	my $shown = $err =~ s/^((?:.*\n){6}).*/$1/sr;

	check($status eq $want, "$text: exit $want", "exit $status", $shown);
	# `check` prints only its last line; other commands print nothing.
	$out =~ s/\A\Q$name\E: \d+ errors?(?:, \d+ warnings?)?\n\z//;
	check($out eq "", "$text: nothing on stdout", substr($out, 0, 200));
	check($err =~ /^\Q$name\E(?::\d+)?(?::\d+)?: .*(?:error|warning) LD\d\d\d: \S/m,
	      "$text: a message with a place", $shown);
	check((() = $err =~ /\n/g) <= 110 && length $err < 40000,
	      "$text: at most a hundred of them", length $err);
}

my $good = <<'END';
RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
END_PROGRAM
END
# A chart with these items.
sub chart {
	return "RUNGBOARD 1\nPROGRAM P SFC\n$_[0]END_PROGRAM\n";
}
# A ClassicLadder project with these members: name, text, name, text …
sub ldmicro { return "LDmicro0.1\nCYCLE=10000\n\nPROGRAM\nRUNG\n$_[0]END\n"; }
sub classic {
	my $text = "_FILES_CLASSICLADDER\n";
	while (my ($name, $lines) = splice @_, 0, 2) {
		$text .= "_FILE-$name\n${lines}_/FILE-$name\n";
	}
	return "${text}_/FILES_CLASSICLADDER\n";
}
sub packed {
	my ($text) = @_;
	my $packed;
	gzip(\$text => \$packed, Time => 0) or die;
	return $packed;
}
my $row = "1-0-50/0 , 9-0-0/0 , 50-0-60/0\n";
spew("good.rung", $good);
spew("good.script", "Start=1\n.\n");
spew("good.io", "BOARD \"sim\"\n%IX0.0 sim\n%QX0.0 sim\n");
my ($status, $out, $err) = run(undef, $ladder, "check", "good.rung");
check($status eq "0", "a good file is good", $err);

my %file = (
	"empty" => "",
	"cut in half" => substr(read_file("$root/ladders/garage-door.rung"), 0,
		length(read_file("$root/ladders/garage-door.rung")) / 2),
	"binary" => join("", map { chr(($_ * 167 + ($_ >> 3)) & 255) } 0 .. 20000),
	"a million of one character" => "|" x 1_000_000,
	"a million letters" => "a" x 1_000_000,
	"a million blanks" => " " x 1_000_000,
	"a million newlines" => "\n" x 1_000_000,
	"a million open comments" => "RUNGBOARD 1\n" . "(*" x 500_000,
	"a million parentheses" => "RUNGBOARD 1\nPROGRAM P LD\nRUNG\n  | [ "
		. "(" x 1_000_000 . " ] | COIL Q0 |\nEND_PROGRAM\n",
	"NUL bytes" => $good =~ s/Start/St\0rt/r,
	"all NUL" => "\0" x 100_000,
	"invalid UTF-8" => $good =~ s/Start/St\xff\xfert/gr,
	"a surrogate" => $good =~ s/Motor/M\xed\xa0\x80r/gr,
	"an open string" => "RUNGBOARD 1\nPROJECT \"garage\n",
	"a newer version" => $good =~ s/RUNGBOARD 1/RUNGBOARD 2/r,
	"a version out of this world" => $good =~ s/RUNGBOARD 1/"RUNGBOARD " . "9" x 400/er,
	"a name of 10,000 characters" => $good =~ s/Motor/"M" x 10_000/ger,
	"numbers out of range" => $good =~ s/: BOOL;\n  Motor/: BOOL;\n  N : INT := 99999;\n  L : DINT := 123456789012345678901234567890;\n  T : TIME := T#999999999999d;\n  Motor/r,
	"an address out of range" => $good =~ s/%QX0.0/%QX99999999999.0/r,
	"a bit out of range" => $good =~ s/%QX0.0/%QX0.9/r,
	"65 columns" => $good =~ s/\| NO Start \|/"|" . " NO Start |" x 70/er,
	"300 rows" => $good =~ s/(  \| NO Start.*\n)/$1 . "  | NO Start ^|\n" x 300/er,
	"no end" => $good =~ s/END_PROGRAM\n//r,
	"no bars" => $good =~ s/\|//gr,
	"a carriage return in the middle" => $good =~ s/Start AT/Start\rAT/r,
	"1,000 arrays of a million texts" => $good =~ s/(  Motor AT.*\n)/$1 . join("", map { sprintf("  A%04d", $_) . " : ARRAY[0..999999] OF STRING[255];\n" } 1 .. 1000)/er,
	"3,000 arrays over one area, all with values" => $good =~ s/(  Motor AT.*\n)/$1 . join("", map { sprintf("  A%04d", $_) . " AT %MX0.0 : ARRAY[0..65535] OF BOOL := [65536(1)];\n" } 1 .. 3000)/er,
	"70 indices in each other" => $good =~ s/NO Start/"[ " . "A[1 + " x 70 . "i" . "]" x 70 . " > 1 ]"/er,
	"a list of 300,000 values for two elements" => $good =~ s/(  Motor AT.*\n)/$1 . "  A : ARRAY[0..1] OF INT := [" . join(",", (1) x 300_000) . "];\n"/er,
	"structures of a thousand of a thousand, 16 deep" => $good =~ s/^VAR/"TYPE\n  D0 : STRUCT\n    X : BOOL;\n  END_STRUCT;\n" . join("", map { "  D$_ : STRUCT\n    X : ARRAY[1..1000] OF D" . ($_ - 1) . ";\n  END_STRUCT;\n" } 1 .. 15) . "END_TYPE\nVAR\n  Deep : D15;"/emr,
	"a path of a thousand indices" => $good =~ s/NO Start/"NO A" . "[1].B" x 1000/er,
	"the same in an expression" => $good =~ s/NO Start/"[ A[i + 1]" . ".B[1]" x 1000 . " > 1 ]"/er,
	"a million structures of a thousand values" => $good =~ s/^VAR/"TYPE\n  M : STRUCT\n" . join("", map { "    V$_ : BOOL;\n    W$_ : INT;\n" } 100 .. 599) . "  END_STRUCT;\nEND_TYPE\n\nVAR\n  Large : ARRAY[1..1000000] OF M;"/emr,
	"10,000 steps" => chart(join "", map { "  STEP S_$_:\n  END_STEP\n" } 1 .. 10_000),
	"10,000 macro-steps in one another" => chart(join "", (map { "  MACRO_STEP M_$_:\n" } 1 .. 10_000), "  END_STEP\n" x 10_000),
	"100,000 open macro-steps" => chart("  MACRO_STEP M:\n" x 100_000),
	"a transition from 200,000 steps" => chart("  STEP A:\n  END_STEP\n  TRANSITION FROM (" . join(", ", ("A") x 200_000) . ") TO A := TRUE; END_TRANSITION\n"),
	"a step of 100,000 lines" => chart("  STEP A:\n" . "    M0.0(N);\n" x 100_000 . "  END_STEP\n"),
	"a step that sets 200,000 bits" => chart("  STEP A:\n    SET " . join(", ", ("M0.0") x 200_000) . ";\n  END_STEP\n"),
	"a condition that does not end" => chart("  STEP A:\n  END_STEP\n  TRANSITION FROM A TO A := " . "I0 AND\n" x 100_000),
	"100,000 actions" => chart("  ACTION A:\n    LD I0\n  END_ACTION\n" x 100_000),
	"an image that is only its name" => "RUNGCODE",
	"a damaged image" => "RUNGCODE" . "\x01\0\0\0" . "\xff" x 500,
	"ClassicLadder: only its first line" => "_FILES_CLASSICLADDER\n",
	"ClassicLadder: cut in half" => substr(classic("rung_0.csv", $row x 8), 0, 150),
	"ClassicLadder: a member without an end" => classic("rung_0.csv", "${row}_FILE-timers.csv\n1,5\n"),
	"ClassicLadder: 100,000 members" => classic(map { ("rung_$_.csv", $row) } 1 .. 100_000),
	"ClassicLadder: one member 50,000 times" => classic(("rung_0.csv", $row) x 50_000),
	"ClassicLadder: 100,000 cells in a row" => classic("rung_0.csv", "9-0-0/0 , " x 100_000 . "\n"),
	"ClassicLadder: dashes for slashes" => classic("rung_0.csv", $row =~ s{/}{-}gr),
	"ClassicLadder: numbers of 400 digits" => classic("rung_0.csv", "1-0-50/" . "9" x 400 . "\n"),
	"ClassicLadder: numbers below zero" => classic("timers.csv", "-1,-1\n", "rung_0.csv", "1-0-50/-3[200/-9]\n"),
	"ClassicLadder: a label of a million letters" => classic("rung_0.csv", "#LABEL=" . "L" x 1_000_000 . "\n$row"),
	"ClassicLadder: rungs in a circle" => classic("sections.csv", "000,0,-1,0,2,0\n", "rung_0.csv", "#NEXTRUNG=1\n$row",
		"rung_1.csv", "#NEXTRUNG=0\n$row", "rung_2.csv", $row),
	"ClassicLadder: no rung is there" => classic("sections.csv", "000,0,-1,0,2,0\n"),
	"ClassicLadder: NUL bytes" => classic("rung_0.csv", "$row\0\0\n"),
	"ClassicLadder: a bomb, 64 MB of zeros" => packed("\0" x (64 << 20)),
	"ClassicLadder: packed, and cut" => substr(packed(classic("rung_0.csv", $row x 8)), 0, -9),
	"ClassicLadder: only gzip's first bytes" => "\x1f\x8b",
	"LDmicro: only its first line" => "LDmicro0.1\n",
	"LDmicro: cut in the middle" => substr(ldmicro("CONTACTS Xa 0\nCOIL Ya 0 0 0\n" x 8), 0, 120),
	"LDmicro: 100,000 circuits in one another" => ldmicro("PARALLEL\nSERIES\n" x 50_000),
	"LDmicro: ends alone" => "LDmicro0.1\nPROGRAM\n" . "END\n" x 1000,
	"LDmicro: NUL bytes" => ldmicro("CONTACTS X\0 0\n"),
	"LDmicro: values are missing" => ldmicro("COIL Ya 0\n"),
	"LDmicro: a million rungs" => "LDmicro0.1\nPROGRAM\n" . "RUNG\nEND\n" x 1_000_000,
	"LDmicro: 20 MB of one name" => ldmicro("CONTACTS X" . "a" x 20_000_000 . " 0\nCOIL Y 0 0 0\n"),
	"numeric rungs: half a cell" => ";Rung:\n1-0-50-\n",
);
for my $text (sort keys %file) {
	my $name = spew("bad.rung", $file{$text});
	refused("$text: ladder check", 1, $name, $ladder, "check", $name);
	next if length $file{$text} > 500_000 && $ENV{QUICK};
	for my $command (["fmt"], ["show"], ["il"], ["code"]) {
		my ($status, $out, $err) = run(undef, $ladder, @$command, $name);
		# A code image has no text to format or draw, which is wrong usage.
		my $image = $file{$text} =~ /^RUNGCODE/;
		check($status eq "1" || ($status eq "2" && $image) ||
		      ($status eq "0" && $command->[0] =~ /fmt|show|il/ &&
		       $file{$text} =~ /^RUNGBOARD 1\n/),
		      "$text: ladder @$command: ends in order", "exit $status", substr($err, 0, 300));
		check($out eq "" || $status eq "0", "$text: ladder @$command: nothing on stdout",
		      substr($out, 0, 200));
		check(length $err || $status eq "0", "$text: ladder @$command: says why");
		check(read_file($name) eq $file{$text}, "$text: ladder @$command: the file is as it was")
			if $status ne "0";
	}
	my ($status, $out, $err) = run(undef, $ladder, "trace", $name, "good.script");
	check($status =~ /^[12]$/ && $out eq "" && length $err,
	      "$text: ladder trace refuses", "exit $status", substr($err, 0, 300));
	($status, $out, $err) = run(undef, $ladder, "test", $name);
	check($status =~ /^[012]$/, "$text: ladder test ends in order", "exit $status", substr($err, 0, 300));
	next unless -x $daemon;
	($status, $out, $err) = run(undef, $daemon, $name, "--io", "good.io", "--check");
	check($status =~ /^[12]$/ && $err =~ /LD\d\d\d/, "$text: ladderd --check refuses",
	      "exit $status", substr($err, 0, 300));
}

# Some editors write CRLF; it can be read.
spew("crlf.rung", $good =~ s/\n/\r\n/gr);
($status, $out, $err) = run(undef, $ladder, "check", "crlf.rung");
check($status eq "0", "CRLF is read", "exit $status", $err);

# ClassicLadder reads at most 2,000 members; here more are allowed.
spew("many.clprj", classic(map { ("rung_$_.csv", "#NEXTRUNG=" . ($_ + 1) . "\n$row") } 0 .. 2999));
($status, $out, $err) = run(undef, $ladder, "check", "many.clprj");
check($status eq "0", "ClassicLadder: 3,000 members are read", "exit $status", substr($err, 0, 300));

# 100,000 rungs, more than a POU may have: refused or read soon.
spew("many.rung", $good =~ s/RUNG\n.*\n/"RUNG\n  | NO Start | COIL Motor |\n" x 100_000/er);
refused("100,000 rungs: ladder check", 1, "many.rung", $ladder, "check", "many.rung");

# Files that cannot be read at all: status 2.
mkdir "folder";
refused("a directory: ladder check", 2, "folder", $ladder, "check", "folder");
refused("no such file: ladder check", 2, "nowhere.rung", $ladder, "check", "nowhere.rung");
for my $command (qw(fmt show il code)) {
	my ($status, $out, $err) = run(undef, $ladder, $command, "nowhere.rung");
	check($status eq "2" && $out eq "" && $err =~ /nowhere\.rung/,
	      "no such file: ladder $command: exit 2", "exit $status", $err);
}
spew("secret.rung", $good);
chmod 0, "secret.rung";
# Root can read everything unless it gives that up.
my @as_user = $> == 0 ? ('setpriv', '--bounding-set=-dac_override,-dac_read_search') : ();
if (@as_user && !grep { -x "$_/setpriv" } split /:/, $ENV{PATH}) {
	check(1, "an unreadable file # SKIP nothing is unreadable to root, and no setpriv(1)");
} else {
	refused("an unreadable file: ladder check", 2, "secret.rung", @as_user, $ladder, "check", "secret.rung");
}
($status, $out, $err) = run(undef, $ladder, "check", "/dev/zero");
check($status eq "2", "a device: ladder check: exit 2", "exit $status", $err);

# Scripts, scenarios and maps that are not text.
for my $text ("empty", "binary", "all NUL", "a million letters", "invalid UTF-8") {
	spew("bad.script", $file{$text});
	my ($status, $out, $err) = run(undef, $ladder, "trace", "good.rung", "bad.script");
	check($text eq "empty" ? $status =~ /^[01]$/ : $status eq "1",
	      "$text as a script: exit 1", "exit $status", substr($err, 0, 300));
	check($out eq "" || $status eq "0", "$text as a script: nothing on stdout");
	check($status eq "0" || $err =~ /bad\.script(:\d+)?.*LD\d\d\d/,
	      "$text as a script: a message with a place", substr($err, 0, 300));
	spew("good.scn", $file{$text});
	($status, $out, $err) = run(undef, $ladder, "test", "good.rung");
	check($text eq "empty" ? $status =~ /^[012]$/ : $status =~ /^[12]$/,
	      "$text as a scenario: refused", "exit $status", substr("$out$err", 0, 300));
	unlink "good.scn";
	next unless -x $daemon;
	spew("bad.io", $file{$text});
	($status, $out, $err) = run(undef, $daemon, "good.rung", "--io", "bad.io", "--check");
	check($text eq "empty" || ($status =~ /^[12]$/ && $err =~ /bad\.io(:\d+)?.*LD\d\d\d/),
	      "$text as a map: refused with a place", "exit $status", substr($err, 0, 300));
}

# A full disk while writing: the old file stays.
if (-e "/dev/full") {
	my ($status, undef, $err) = run("/dev/full", $ladder, "show", "good.rung");
	check($status =~ /^[12]$/ && length $err, "a full disk behind stdout is reported", "exit $status", $err);
}
my $ugly = $good =~ s/  \| NO Start/|    NO   Start/r;
spew("ugly.rung", $ugly);
my $limited = fork;
if (!$limited) {
	# No file may grow: write() fails as on a full disk.
	$SIG{XFSZ} = 'IGNORE';
	open STDOUT, '>', '/dev/null';
	open STDERR, '>', '/dev/null';
	{ exec "sh", "-c", q{trap "" XFSZ; ulimit -f 0; exec "$@"}, "sh", $ladder, "fmt", "ugly.rung" }
	POSIX::_exit(127);
}
waitpid $limited, 0;
check($? >> 8 == 1 || $? >> 8 == 2, "fmt on a full disk fails in order", "status $?");
check(read_file("ugly.rung") eq $ugly, "fmt on a full disk leaves the old file");
my @rest = grep { !/^(?:bad|good|ugly|crlf|many|secret)\.|^(?:folder|out|err)$/ } glob("{*,.[a-z]*}");
check(!@rest, "fmt on a full disk leaves nothing else", @rest);

# A closed pipe ends the program without a message.
($status, $out, $err) = run(undef, 'sh', '-c',
	'for i in 1 2 3; do "$0" show "$1" || exit; done | true; exit 0', $ladder, "good.rung");
check($status eq "0" && $err !~ /Sanitizer|Assertion/, "a closed pipe", $err);

print "1..$n\n";
exit $failed;
