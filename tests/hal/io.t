#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# io.t - tests `ladder io` with fake chips and each gpio driver: every line with its owner,
# pull and level, the names of a program, and the live view. It requests no line.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Path qw(make_path);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use File::Basename qw(dirname);
use lib abs_path(dirname(__FILE__)) . '/..';
use Terminal;

my $build = abs_path($ENV{BUILD} // 'build');
my $dir = tempdir(CLEANUP => 1);
chdir $dir or die;
delete @ENV{grep { /^FAKE_/ } keys %ENV};
mkdir 'dev';
sub put { my ($name, $text) = @_; open my $f, '>', $name or die; print $f $text; close $f }
sub get { my ($name) = @_; open my $f, '<', $name or die; local $/; my $text = <$f>; return $text // '' }
put("dev/gpiochip$_", '') for 0, 1;
$ENV{FAKE_DEV} = "$dir/dev";
$ENV{FAKE_TAKEN} = "$dir/taken";

put('lamp.rung', <<'END');
RUNGBOARD 1
PROJECT "Lamp"

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | NC Stop | COIL Lamp |
END_PROGRAM
END
put('panel.io', <<'END');
BOARD "panel"
%IX0.0 gpio line=IN0
%IX0.1 gpio line=IN1
%IX0.2 sim
%QX0.0 gpio chip=panel offset=2 safe=0
%QX0.1 gpio chip=gpiochip0 offset=3 safe=0
END
put('other.io', "BOARD \"other\"\n%IX0.0 gpio line=IN0\n%IX0.1 gpio line=NOWHERE\n");
put('levels', <<'END');
gpiochip0: GPIOs 512-515, parent: platform/panel, panel:
 gpio-512 (IN0                 |ladderd             ) in  hi
 gpio-513 (IN1 (spare)         |ladderd             ) in  lo ACTIVE LOW
 gpio-514 (OUT0                |ladderd             ) out hi
 gpio-511 (                    |nobody              ) in  hi

gpiochip1: GPIOs nonsense
 gpio-600 (                    |kernel              ) in  hi
END

my $ladder;
# Exit status, standard output, standard error.
sub io {
	my (@args) = @_;
	my $pid = fork // die;
	if (!$pid) {
		open STDIN, '<', '/dev/null'; open STDOUT, '>', '.out'; open STDERR, '>', '.err';
		exec $ladder, 'io', @args or die;
	}
	local $SIG{ALRM} = sub { kill 9, $pid };
	alarm 20; waitpid $pid, 0; my $status = $?; alarm 0;
	return ($status & 127 ? "signal $status" : $status >> 8, get('.out'), get('.err'));
}
sub fields { return map { [split ' '] } split /\n/, $_[0] }

for my $kind (qw(v1 v2 uapi)) {
	$ladder = "$build/tests/hal/ladder_$kind";
	SKIP: {
	-x $ladder or skip "$ladder was not built", 1;

	# ---- no line is in use ----
	unlink 'taken';
	delete @ENV{qw(FAKE_LEVELS FAKE_DENIED)};
	my ($status, $out, $err) = io();
	is("$status$err", '0', "$kind: all lines: good");
	my @rows = fields($out);
	is(scalar @rows, 7, "$kind: all lines, below one line of words");
	is_deeply($rows[1], [qw(IN0 panel gpiochip0 0 input - - free)], "$kind: a free line");
	is_deeply([@{$rows[5]}[0 .. 5, 7, 8]], ['-', qw(rest gpiochip1 0 input -), 'in', 'use'], "$kind: a line without a name, in use by a nameless one");
	($status, $out) = io('panel.io');
	like("$status $out", qr/\A0 %IX0\.0 +gpio +IN0 +input +good\n.*good\n\z/ms, "$kind: the map fits");

	# ---- ladderd uses lines ----
	put('taken', '');
	$ENV{FAKE_LEVELS} = "$dir/levels";
	($status, $out, $err) = io('panel.io');
	is($status, 1, "$kind: as a check, lines in use are wrong");
	like($err, qr/error LD510: .*ladderd/, "$kind: and by whom");
	($status, $out, $err) = io('panel.io', '--program', 'lamp.rung');
	is("$status$err", '0', "$kind: as a picture, they are good");
	@rows = fields($out);
	is_deeply(\@rows, [
		[qw(address variable line chip offset now level bias owner)],
		[qw(%IX0.0 Start IN0 gpiochip0 0 input high pull-up ladderd)],
		[qw(%IX0.1 Stop IN1 gpiochip0 1 input low pull-down active-low ladderd)],
		[qw(%IX0.2 - - simulated)],
		[qw(%QX0.0 Lamp panel 2 gpiochip0 2 output high - ladderd)],
		[qw(%QX0.1 - gpiochip0 3 gpiochip0 3 input - - free)],
	], "$kind: address, variable, line, chip, direction, level, pull, owner") or diag($out);
	($status, $out, $err) = io('--live', 'panel.io');
	@rows = fields($out);
	is("$status @{$rows[1]}[0 .. 2]", '0 %IX0.0 - IN0', "$kind: --live in a pipe prints once");
	($status, $out) = io('--json', 'panel.io', '--program', 'lamp.rung');
	my $json = decode_json($out);
	is($status, 0, "$kind: as JSON");
	is_deeply($json->{points}[1], { address => '%IX0.1', variable => 'Stop', driver => 'gpio', line => 'IN1',
		here => { chip => 'gpiochip0', label => 'panel', offset => 1, name => 'IN1', owner => 'ladderd', used => JSON::PP::true,
			  output => JSON::PP::false, active_low => JSON::PP::true, bias => 'pull-down', level => 0 } }, "$kind: JSON of a line");
	is($json->{points}[2]{here}, undef, "$kind: JSON of a simulated line");
	($status, $out) = io('--json');
	$json = decode_json($out);
	is_deeply([map { $_->{level} } @{$json->{lines}}], [1, 0, 1, undef, undef, undef], "$kind: a level is only what the kernel said");

	# ---- missing files, no permission, bad maps ----
	($status, $out, $err) = io('other.io', '--program', 'lamp.rung');
	is($status, 1, "$kind: a map of another board");
	like($out, qr/^%IX0\.1 +Stop +NOWHERE +not on this machine$/m, "$kind: its line is named");
	$ENV{FAKE_DENIED} = 1;
	($status, $out, $err) = io();
	is($status, 1, "$kind: a chip that may not be opened");
	like($err, qr/error LD511: .*: gpiochip1 \(\?\)$/m, "$kind: says so, and that its group cannot be seen");
	like($out, qr/^OUT1 /m, "$kind: the rest is shown");
	delete $ENV{FAKE_DENIED};
	is((io('--program', 'lamp.rung'))[0], 2, "$kind: a program without a map");
	is((io('panel.io', '--program', 'nothing'))[0], 2, "$kind: no such program");
	put('bad.rung', get('lamp.rung') =~ s/NC Stop/NC Stopp/r);
	($status, $out, $err) = io('panel.io', '--program', 'bad.rung');
	is("$status$out", '1', "$kind: a bad program");
	like($err, qr/LD301/, "$kind: its error");

	# ---- a map with values of devices ----
	{
		local $ENV{FAKE_SYS} = "$dir/sys";
		unlink 'taken';
		make_path("$dir/sys/$_") for 'bus/w1/devices/28-1', 'bus/w1/devices/28-2', 'class/hwmon/hwmon0';
		put('sys/bus/w1/devices/28-1/temperature', "21437\n");
		put('sys/bus/w1/devices/28-2/temperature', "85000\n");
		put('sys/class/hwmon/hwmon0/name', "cpu_thermal\n");
		put('sys/class/hwmon/hwmon0/temp1_input', "48312\n");
		put('analog.io', "BOARD \"b\"\nBUS m modbus-tcp host=127.0.0.1\n%AIW0 w1 sensor=28-1\n%AIW2 hwmon device=cpu_thermal channel=temp1\n" .
			"%AIW4 w1 sensor=28-2\n%AIW6 hwmon device=hwmon0 channel=temp1\n" .
			"%AIW8 modbus bus=m unit=1 input-register=0\n%IX0.0 gpio line=IN0\n");
		($status, $out, $err) = io('analog.io');
		is($status, 0, "$kind: a map with devices") or diag $err;
		like($out, qr/^%AIW0 +w1 .* good   21\.437 \x{c2}\x{b0}C\n%AIW2 +hwmon .* good   48\.312 \x{c2}\x{b0}C\n%AIW4 +w1 .* good   no valid measurement\n%AIW6 +hwmon .* good   48\.312 /m,
		     "$kind: each line of a device with its value, or why there is none");
		like($out, qr/^%AIW8 +modbus .* good\n%IX0\.0 +gpio .* good\n/m, "$kind: others without");
		($status, $out) = io('--json', 'analog.io');
		is(decode_json($out)->{points}[0]{value}, "21.437 \x{b0}C", "$kind: the value in JSON");
	}

	# ---- a map with errors: what reads well is checked on this machine in the same run ----
	{
		local $ENV{FAKE_SYS} = "$dir/sys";
		unlink 'taken';
		put('wrong.io', <<'END');
BOARD "b"
BUS m modbus-tcp host=127.0.0.1
%IX0.0 gpio line=IN0
%IX0.0 sim
%IX0.1 gpio line=NOWHERE
%AIW0 w1 sensor=28-9
%AIX2.0 w1 sensor=28-1
%XIB0..2 module bus=m unit=1 type=DIO9999
%AIW4 modbus bus=missing unit=1 input-register=0
%AIW6 hwmon device=cpu_thermal channel=temp1 range=9..0 at 0C..100C limits=50C..20C
%AIW8 w1 sensor=28-1
%QX0.0 gpio line=OUT0 safe=0
END
		($status, $out, $err) = io('wrong.io');
		is($status, 1, "$kind: a map with errors is wrong");
		my %said;
		push @{$said{$1}}, $2 while $err =~ /^wrong\.io:(\d+):\d+: (.*)$/mg;
		is(join(' ', sort { $a <=> $b } keys %said), '4 5 6 7 8 9 10', "$kind: each wrong line is told in one run") or diag $err;
		like("@{$said{4}}", qr/^error LD506: "%IX0\.0" is in the map twice/, "$kind: two owners of an address");
		like("@{$said{5}}", qr/NOWHERE/, "$kind: a line that this machine does not have");
		like("@{$said{6}}", qr/28-9/, "$kind: a sensor that it does not have");
		like("@{$said{8}}", qr/DIO9999/, "$kind: an unknown module");
		like("@{$said{9}}", qr/missing/, "$kind: a bus that is not there");
		like("@{$said{10}}", qr/^error LD533: "range=9\.\.0"/, "$kind: a range upside down");
		like($out, qr/^%IX0\.0 +gpio +IN0 +input +good\n%IX0\.1 +gpio +NOWHERE +input +wrong\n/, "$kind: lines that read well are listed");
		like($out, qr/^%AIW8 +w1 .* good +21\.437 /m, "$kind: with their values");
		($status, $out) = io('--json', 'wrong.io');
		my $read = decode_json($out);
		is("$status " . join(' ', map { $_->{address} . ($_->{good} ? '' : '!') } @{$read->{points}}),
		   '1 %IX0.0 %IX0.1! %AIW0! %AIW8 %QX0.0', "$kind: also as JSON");
		($status, $out) = io('wrong.io', '--program', 'lamp.rung');
		is("$status$out", '1', "$kind: a picture needs the whole map");
	}

	# ---- live ----
	SKIP: {
		skip 'no script(1) to make a terminal', 4 unless has_terminal();
		unlink 'taken';
		my ($ended, $screen) = on_terminal(12, 100, "\Q$ladder\E io panel.io --program lamp.rung --live",
			qr/Start +IN0 +gpiochip0 +0 .* free/s => sub { put('taken', '') }, qr/ladderd/ => 'q');
		is($ended, 0, "$kind: live ends well with q");
		like($screen, qr/Rungboard panel .*Start +IN0 +gpiochip0 +0 +input.* free.*Start +IN0 +gpiochip0 +0 +input +high +pull-up +ladderd/s,
		     "$kind: live shows that somebody took the line");
		($ended, $screen) = on_terminal(6, 100, "\Q$ladder\E io --live", qr/1 to 3 of 6/ => ' ', qr/4 to 6 of 6/ => 'q');
		like($screen, qr/1 to 3 of 6; space: next page.*4 to 6 of 6/s, "$kind: live turns pages");
		unlike($screen, qr/levels: not told/, "$kind: live says nothing of levels when they are known");
	}
	}
}
chdir '/';
done_testing();
