#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# pins - presses the keys of an emulated board and reads its LEDs from outside, with the
# machine protocol of the emulator (QMP).
#
#   pins.pl LADDER PROGRAM FOLDER NAME... -- EMULATOR...
#
# The guest runs PROGRAM once for each NAME. Each step sets the keys. The LEDs must then be
# as in the output of `LADDER trace` for the same keys at the same times. A step waits until
# they are, far longer than a board needs, and then checks that they stay so. FOLDER
# contains the socket `qmp`; the console of the guest goes to `serial` there.
use strict;
use warnings;
use IO::Socket::UNIX;
use JSON::PP;
use POSIX ();
use Time::HiRes qw(sleep time);

my $HANGS = 600;    # seconds for one step: then the guest is dead, also on a slow machine
my $PERIOD = 10;    # ms, of a scan
my @steps = (       # keys I0 I1 I2, ms that they stay, what it is
	['000', 300, 'all is off, keys at rest'],
	['100', 300, 'key I0 held: nothing yet'],
	['000', 300, 'key I0 let go: Q0 on'],
	['001', 300, 'key I2: not below 0'],
	['000', 300, 'and let go'],
	['010', 300, 'key I1: 1'],
	['000', 300, 'and let go: still 1'],
	['010', 300, 'key I1: 2'],
	['000', 300, 'and let go: still 2'],
	['010', 300, 'key I1: 3'],
	['000', 300, 'and let go: still 3'],
	['010', 300, 'key I1: 4'],
	['000', 300, 'and let go: still 4'],
	['001', 300, 'key I2: back to 3'],
	['011', 1500, 'both keys: 4, not yet 0'],
	['011', 1500, 'both keys for two seconds: 0, and Q0 stays'],
	['000', 300, 'and let go'],
	['100', 300, 'key I0 held: Q0 stays on'],
	['000', 300, 'key I0 let go: Q0 off'],
	['010', 300, 'key I1: 1, so that an LED is on at the end'],
);

my ($ladder, $program, $folder, @names) = @ARGV;
my ($cut) = grep { $names[$_] eq '--' } 0 .. $#names;
my @emulator = splice @names, $cut + 1;
pop @names;

# The LEDs after each step, as "0100" for Q0 to Q3.
sub expected {
	open my $script, '>', "$folder/steps" or die "$folder/steps: $!";
	print $script "\@print Q0 Q1 Q2 Q3\n\@period ${PERIOD}ms\n";
	for (@steps) {
		my ($keys, $ms) = @$_;
		my ($i0, $i1, $i2) = split //, $keys;
		printf $script "I0=%d I1=%d I2=%d x%d quiet\n", $i0, $i1, $i2, $ms / $PERIOD;
	}
	close $script or die "$folder/steps: $!";
	open my $trace, '-|', $ladder, 'trace', $program, "$folder/steps" or die "$ladder: $!";
	my @leds = map { join '', /Q\d=(\d)/g } <$trace>;
	close $trace or die "$ladder trace failed";
	@leds == @steps or die "$ladder trace: " . @leds . ' lines for ' . @steps . ' steps';
	return @leds;
}

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
sub keys_are { # active-low: a pressed key is 0; returns when they were not yet set
	my @keys = split //, shift;
	my $before = time;

	ask('qom-set', path => '/machine/soc/gpio', property => "gpioA$_",
		value => $keys[$_] ? JSON::PP::false : JSON::PP::true) for 0 .. 2;
	return $before;
}
sub leds {
	return join '', map {
		ask('qom-get', path => '/machine/soc/gpio', property => "gpioB$_") ? 0 : 1;
	} 0 .. 3;
}

my ($count, $failed) = (0, 0);
sub ok {
	my ($good, $text, $found) = @_;

	printf "%s %d - %s\n", $good ? 'ok' : 'not ok', ++$count, $text;
	$failed++ unless $good;
	print "#   found $found\n" if !$good && defined $found;
}
sub wait_for {
	my ($good) = @_;
	my $until = time + $HANGS;

	while (time < $until) {
		return 1 if $good->();
		last if is_dead();
		sleep 0.02;
	}
	return 0;
}
sub is_dead { return console() =~ /Kernel panic|Internal error:|Unable to handle kernel/ }
# Checks that the LEDs become @want, and stay so for @ms. With @set, when the keys were set, and @was,
# the LEDs until then: they go on by themselves later than @ms after the guest saw the keys, which it
# had not yet when they still were @was. A look that comes after that says nothing.
sub shows {
	my ($want, $ms, $text, $set, $was) = @_;
	my ($now, $seen, $late, $until) = ('', 0, 0, 0);
	my $good = wait_for(sub {
		my $before = time;

		$now = leds();
		return $now eq $want unless $was;
		$set = $before if $now eq $was;
		$until = $set + $ms / 1000;
		$seen ||= $now ne $was && time < $until;
		$late = $now ne $was && !$seen;
		return $late || $now eq $want;
	});

	$until = time + $ms / 1000 unless $was;
	while ($good && time < $until) {
		$now = leds();
		last if $was && time >= $until;
		last unless $good = $now eq $want;
		sleep 0.02;
	}
	if ($late) { printf "ok %d - %s # SKIP this machine looked too late\n", ++$count, $text }
	else { ok($good, "$text: LEDs $want", $now) }
	return $good;
}
sub console {
	open my $in, '<', "$folder/serial" or return '';
	local $/;
	return <$in> // '';
}

$| = 1;
my @leds = expected();
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

print "BEGIN pins\n";
wait_for(sub { $qmp = IO::Socket::UNIX->new("$folder/qmp") }) or die "no $folder/qmp: $!";
$qmp->autoflush(1);
<$qmp>;
ask('qmp_capabilities');
keys_are('000');
for my $run (0 .. $#names) {
	# The debounce of the keys begins with the first scan.
	my $name = $names[$run];
	my $good = shows($leds[0], $steps[0][1], "$name: $steps[0][2]");
	for my $i (1 .. $#steps) {
		last unless $good;
		my $set = keys_are($steps[$i][0]);
		# Both keys reset the count after two seconds. The count is checked for less, because a
		# guest may be late but never early.
		my $long = $steps[$i][1] > 1000;
		my $passes = $long && $steps[$i][0] ne $steps[$i - 1][0];
		$good = shows($leds[$i], $steps[$i][1] * ($long ? 0.7 : 1), "$name: $steps[$i][2]", $set,
			$passes && $leds[$i - 1]);
	}
	keys_are('000');
	syswrite $keyboard, "x";
	my $ended = wait_for(sub { (() = console() =~ /^RC=\d/mg) > $run });
	my ($code) = (console() =~ /^RC=(\d+)/mg)[$run];
	ok($ended && defined $code && $code == 0, "$name: ladderd ended well on SIGTERM", $code);
	# Then the next program may begin at once: it has the lines when its own LEDs are lit.
	last unless $ended;
}
ok(wait_for(sub { console() =~ /^END/m }), 'the guest came to its end');
ok(wait_for(sub { leds() eq '0001' }), 'then the LEDs have their safe values', leds());
print "1..$count\n\nRC=", $failed ? 1 : 0, "\nEND\n";
if ($failed) { print "# $_\n" for grep { length } split /\r?\n/, console() }
kill KILL => $emulator;
waitpid $emulator, 0;
$emulator = 0;
exit($failed ? 1 : 0);
