#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# quality.t - `ladder trace --io` marks values that the inputs of the driver `quality` call bad, in its three
# forms; without --io, and where all is good, nothing is marked.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} // 'build';
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);

sub spill {
	my ($name, $text) = @_;
	open my $file, '>', "$folder/$name" or die "$name: $!";
	print $file $text;
	close $file or die;
}

# What it prints, and its exit status.
sub trace {
	my ($map, @options) = @_;
	my $io = $map ? "--io $folder/$map" : '';
	my $said = `$ladder trace $folder/p.rung $folder/p.script $io @options 2>$folder/err`;
	return ($said, $? >> 8);
}

sub told {
	open my $file, '<', "$folder/err" or die;
	return join '', grep { !/warning/ } <$file>;
}

spill('p.rung', <<'END');
RUNGBOARD 1
VAR
  Level AT %AIW0 : INT;
  Good  AT %IX20.0 : BOOL;
  How   AT %IB21 : USINT;
  Heat  AT %AIW2 : INT;
  Cold  AT %AIW4 : INT;
  Deep  AT %ID24 : DINT;
  Out   AT %QX0.0 : BOOL;
END_VAR
PROGRAM Main LD
RUNG
  | NO Good | COIL Out |
END_PROGRAM
END
spill('p.io', <<'END');
BOARD "x"
%AIW0 iio device=ads1115 channel=voltage0 stale=1s
%AIW2 w1 sensor=28-000005e2fdc3
%AIW4 w1 sensor=28-000005e2fdc4
%IX20.0 quality of=%AIW0
%IB21 quality of=%AIW2..4
%ID24 quality of=%AIW4
%QX0.0 sim safe=0
END
spill('none.io', qq(BOARD "x"\n%AIW0 sim\n%QX0.0 sim\n));
spill('far.io', qq(BOARD "x"\n%IX900.0 sim\n));
spill('bad.io', qq(BOARD "x"\n%AIW0 nothing\n));
spill('p.script', "\@print Level Heat Cold %AIB0 Out\nLevel=5 Good=1\nHow=2\nHow=1 Good=0\nHow=0 Good=1 Deep=1\nDeep=2\nDeep=0\nHow=3 Deep=3\nHow=1\n");

my ($said, $status) = trace('p.io');
is($status, 0, 'it runs with a map');
is($said, <<'END', 'lines: each value that is not good has its word');
1 t=10 Level=5 Heat=0 Cold=0 %AIB0=5 Out=1
2 t=20 Level=5 Heat=0!fault Cold=0!fault %AIB0=5 Out=1
3 t=30 Level=5!stale Heat=0!stale Cold=0!stale %AIB0=5!stale Out=0
4 t=40 Level=5 Heat=0 Cold=0!stale %AIB0=5 Out=1
5 t=50 Level=5 Heat=0 Cold=0!fault %AIB0=5 Out=1
6 t=60 Level=5 Heat=0 Cold=0 %AIB0=5 Out=1
7 t=70 Level=5 Heat=0!forced Cold=0!forced %AIB0=5 Out=1
8 t=80 Level=5 Heat=0!stale Cold=0!stale %AIB0=5 Out=1
END
is((trace('p.io', '--changes'))[0], <<'END', 'another quality is a change, also back to good');
1 t=10 Level=5 %AIB0=5 Out=1
2 t=20 Heat=0!fault Cold=0!fault
3 t=30 Level=5!stale Heat=0!stale Cold=0!stale %AIB0=5!stale Out=0
4 t=40 Level=5 Heat=0 %AIB0=5 Out=1
5 t=50 Cold=0!fault
6 t=60 Cold=0
7 t=70 Heat=0!forced Cold=0!forced
8 t=80 Heat=0!stale Cold=0!stale
END
like((trace('p.io', '--csv'))[0], qr/^3,30,5!stale,0!stale,0!stale,5!stale,0\r\n4,40,5,0,0!stale,5,1\r$/m, 'CSV');
my $wave = (trace('p.io', '--vcd'))[0];
my @notes = $wave =~ /^\$comment (\w+: \w+) \$end$/mg;
is("@notes", 'Heat: fault Cold: fault Level: stale Heat: stale Cold: stale Level: good Heat: good Cold: fault Cold: good Heat: forced Cold: forced Heat: stale Cold: stale',
	'a wave has comments');
like($wave, qr/^#20000000\n\$comment Heat: fault/m, 'at their time');

my $plain = (trace(undef))[0];
unlike($plain, qr/!/, 'without --io nothing is marked');
is((trace('none.io'))[0], $plain, 'a map that tells no quality changes nothing');
(my $good = $said) =~ s/!\w+//g;
is($good, $plain, 'marks are all that a map adds');

is((trace('bad.io'))[1], 1, 'a map with an error is refused');
like(told(), qr/bad\.io:2:7: error LD503/, 'with its place');
is((trace('far.io'))[1], 1, 'so is one that the program has no room for');
like(told(), qr/far\.io:2:1: error LD/, 'with its place');
is((trace('nowhere.io'))[1], 2, 'and one that is not there');
done_testing();
