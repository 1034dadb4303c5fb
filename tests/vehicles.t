#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# vehicles.t - what an emulated board says when its guest does not come to its end (tests/targets/lib/vehicle.sh). The
# emulators here are shells that print what a guest prints. tests/targets/uml has a real kernel that dies.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Path qw(make_path);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $dir = tempdir(CLEANUP => 1);
make_path("$dir/tests/targets");
symlink "$tests/targets/lib", "$dir/tests/targets/lib" or die $!;

# Runs a vehicle whose emulator does @$guest; HANGS is how long it may say nothing.
sub vehicle {
	my ($guest, $hangs) = @_;
	spew("$dir/tests/targets/toy", ". \"\$(dirname \"\$0\")/lib/vehicle.sh\"\nboot sh -c '$guest'\nguest_said\n");
	my $said = `cd '$dir' && HANGS=$hangs BUILD=build RUNGBOARD_CACHE='$dir/cache' sh tests/targets/toy 2>/dev/null`;
	return ($?, $said, slurp("$dir/build/targets/toy/result"));
}

my $good = 'echo BEGIN /guest; echo 1..1; echo ok 1 - a line; echo RC=0; ';
my ($status, $said, $result) = vehicle($good . 'echo END', 60);
is($status, 0, 'a guest that comes to its end is good');
like($result, qr/^toy +passed: 2 tests /, '... and its tests are counted');

my %dying = (
	'a kernel that panics' => 'Kernel panic - not syncing: Attempted to kill init!',
	'a kernel without memory' => 'Kernel panic - not syncing: System is deadlocked on memory',
	'a kernel that meets its own fault' => 'Unable to handle kernel paging request at virtual address 00000000',
	'a board that does not restart' => 'Reboot failed -- System halted',
);
for my $what (sort keys %dying) {
	# It goes on for ever, as the emulators of some boards do.
	($status, $said, $result) = vehicle($good . "echo \"[    1.000000] $dying{$what}\"; exec sleep 600", 600);
	isnt($status, 0, "$what fails the run");
	like($said, qr/^not ok 3 - the guest was ended: .*\Q$dying{$what}\E$/m, '... and its words are shown');
	like($said, qr/^# console: .*\Q$dying{$what}\E/m, '... and the end of the console');
	like($result, qr/^toy +FAILED: /, '... and in the last line');
}

($status, $said, $result) = vehicle($good . 'while :; do echo "[ 1.0] the same again"; sleep 1; done', 4);
isnt($status, 0, 'a guest that says nothing new fails the run');
like($said, qr/^not ok 3 - the guest was ended: it printed no line of TAP for 4 s$/m, '... and it is said why');

($status, $said) = vehicle($good . 'echo Kernel panic - not syncing: No init', 60);
isnt($status, 0, 'a kernel that panics, whose emulator ends by itself, fails the run');
like($said, qr/^not ok 3 - .* its kernel said: Kernel panic - not syncing: No init$/m, '... and its words are shown');

($status, $said) = vehicle($good, 60);
isnt($status, 0, 'a guest whose emulator ends too early fails the run');
like($said, qr/^not ok 3 - each guest came to its end$/m, '... and it is said why');

($status, $said) = vehicle('echo BEGIN /guest; echo 1..2; echo ok 1 - a line; echo RC=0; echo END', 60);
like($said, qr/^not ok 2 - \S* ended: 1 tests of 2, status 0$/m, 'a command that stops before its plan fails');
($status, $said) = vehicle('echo BEGIN /guest; echo 1..1; echo ok 1 - a line; echo RC=139; echo END', 60);
like($said, qr/^not ok 2 - \S* ended: 1 tests of 1, status 139$/m, 'a command that dies fails');
done_testing();
