#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# sensor - warms and cools a TMP105 of an emulated board from outside, with the machine protocol of the emulator (QMP),
# and reads what ladderd prints.
#
#   sensor.pl FOLDER EMULATOR...
#
# The guest runs a ladderd whose program copies the temperature to %QW0, with --trace-io. The sensor's id is `sensor`.
# FOLDER contains the socket `qmp`; the console of the guest goes to `serial` there.
use strict;
use warnings;
use IO::Socket::UNIX;
use JSON::PP;
use POSIX ();
use Time::HiRes qw(sleep time);

my $HANGS = 600; # seconds: then the guest is dead, also on a slow machine
# Thousandths of a degree, and hundredths as the program sees them: the sensor has steps of 1/16 degree.
my @steps = ([25000, 2500], [31250, 3125], [-12500, -1250], [0, 0], [99938, 9994]);
my ($folder, @emulator) = @ARGV;

my ($qmp, $json) = (undef, JSON::PP->new);
sub ask {
	my ($execute, %arguments) = @_;

	print $qmp $json->encode({ execute => $execute, arguments => \%arguments }), "\n";
	while (defined(my $line = <$qmp>)) {
		my $answer = $json->decode($line);
		die "$execute: $answer->{error}{desc}\n" if $answer->{error};
		return $answer->{return} if exists $answer->{return};
	}
	die "$execute: the emulator ended\n";
}
sub console {
	open my $in, '<', "$folder/serial" or return '';
	local $/;
	return <$in> // '';
}
sub wait_for {
	my ($good) = @_;
	my $until = time + $HANGS;

	while (time < $until) {
		return 1 if $good->();
		last if console() =~ /Kernel panic|Internal error:|Unable to handle kernel|^END/m;
		sleep 0.05;
	}
	return $good->();
}
my ($count, $failed) = (0, 0);
sub ok {
	my ($good, $text) = @_;

	printf "%s %d - %s\n", $good ? 'ok' : 'not ok', ++$count, $text;
	$failed++ unless $good;
}
# The last value that the program has told.
sub told { return (console() =~ /^%QW0 (-?\d+)\r?$/mg)[-1] // 'nothing' }

$| = 1;
unlink "$folder/qmp", "$folder/serial";
pipe my $from, my $keyboard or die "pipe: $!";
my $emulator = fork // die "fork: $!";
if (!$emulator) {
	open STDIN, '<&', $from;
	open STDOUT, '>', "$folder/serial";
	open STDERR, '>&', \*STDOUT;
	exec @emulator or POSIX::_exit(127);
}
END { local $?; kill KILL => $emulator if $emulator }
$SIG{$_} = sub { exit 130 } for qw(INT TERM PIPE);

print "BEGIN sensor\n";
wait_for(sub { $qmp = IO::Socket::UNIX->new("$folder/qmp") }) or die "no $folder/qmp: $!";
$qmp->autoflush(1);
<$qmp>;
ask('qmp_capabilities');
for my $step (@steps) {
	my ($set, $want) = @$step;

	ask('qom-set', path => '/machine/peripheral/sensor', property => 'temperature', value => $set);
	my $good = wait_for(sub { told() eq $want });
	ok($good, "the sensor has $set thousandths of a degree, the program $want hundredths");
	print '#   it has ', told(), "\n" unless $good;
	last unless $good;
}
syswrite $keyboard, "x";
ok(wait_for(sub { console() =~ /^RC=0/m }), 'ladderd ended well on SIGTERM');
ok(wait_for(sub { console() =~ /^END/m }), 'the guest came to its end');
print "1..$count\n\nRC=", $failed ? 1 : 0, "\nEND\n";
if ($failed) { print "# $_\n" for grep { length } split /\r?\n/, console() }
kill KILL => $emulator;
waitpid $emulator, 0;
$emulator = 0;
exit($failed ? 1 : 0);
