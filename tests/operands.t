#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# operands.t - every function with every type at every pin: `ladder check` accepts it, or
# refuses it with a message about types. Accepted calls run with the limits of all types
# without a finding of the sanitizers.
#
# For functions whose result has the type of their inputs the accepted types must be those
# of the row of catalog.def. Results are not tested.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib map { abs_path(dirname(__FILE__)) . $_ } '', '/bad';
use Files;
use Rows;

my $tests = abs_path(dirname(__FILE__));
my $build = $ENV{BUILD} // "$tests/../build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
# An old build with sanitizers would test another program.
my $sanitized = -x "$build/asan/ladder" && -M "$build/asan/ladder" <= -M $ladder;
my $runner = $sanitized ? abs_path("$build/asan/ladder") : $ladder;
my $folder = tempdir(CLEANUP => 1);
my $at_once = 40; # a file shows only 100 messages

# Each type with difficult values, one per scan.
my %values = (
	BOOL => [0, 1], BYTE => [0, 255], WORD => [1, 65535],
	DWORD => ['16#7F800001', 4294967295], LWORD => [1, '18446744073709551615'],
	SINT => [-128, 127], INT => [-32768, 32767], DINT => [-2147483648, 2147483647],
	LINT => ['-9223372036854775808', '9223372036854775807', -1],
	USINT => [0, 255], UINT => [0, 65535], UDINT => [0, 4294967295],
	ULINT => ['9223372036854775808', '18446744073709551615', 0],
	REAL => ['-3.4E38', '0.5', '3.4E38', '9.3E18'],
	LREAL => ['-1.7E308', '1.5', '1.8446744073709552E19', '-9.3E18'],
	TIME => ['T#-106751d', 'T#106751d', 'T#0s'],
	TIME_OF_DAY => ['TOD#23:59:59.999999999', 'TOD#00:00:00'],
	DATE => ['D#1677-09-22', 'D#2262-04-11'],
	DATE_AND_TIME => ['DT#1677-09-22-00:00:00', 'DT#2262-04-11-23:00:00'],
	STRING => ["''", "'a longer text'"],
);
my @types = sort keys %values;
my @some = qw(BOOL INT REAL DWORD LINT STRING TIME);

# The rungs of a row: one type at all pins that share a type, each pin alone, constants.
sub combinations {
	my ($row) = @_;
	my @pins = @{$row->{pins}};
	my @all;
	my $usual = sub { (grep { $_[0]{takes}{$_} } qw(INT BOOL DWORD REAL STRING
		TIME TIME_OF_DAY DATE DATE_AND_TIME))[0] };
	for my $type (@types) {
		for my $out ($type, @some) {
			push @all, { out => $out, shared => $type, pins => [map {
				'v' . ($_->{own} ? $usual->($_) : $type) } @pins] };
		}
		for my $which (0 .. $#pins) {
			push @all, { pins => [map { 'v' . ($_ == $which ? $type :
				$usual->($pins[$_])) } 0 .. $#pins] };
			push @all, { pins => [map { $_ == $which ? $values{$type}[0] :
				'v' . $usual->($pins[$_]) } 0 .. $#pins] };
		}
	}
	for my $one (@all) {
		$one->{text} = join ' ', $row->{word}, map { "$pins[$_]{name}:=$one->{pins}[$_]" }
			0 .. $#pins;
		$one->{text} .= " OUT=>o$one->{out}" if $one->{out};
	}
	return @all;
}

sub write_program {
	my (@rungs) = @_;
	open my $out, '>', "$folder/main.rung" or die "main.rung: $!";
	print $out "RUNGBOARD 1\n\nVAR\n";
	print $out "  v$_ : $_ := ", $values{$_}[0] =~ /^[01]$/ && $_ eq 'BOOL' ?
		'FALSE' : $values{$_}[0], ";\n  o$_ : $_;\n" for @types;
	print $out "END_VAR\n\nPROGRAM Main LD\n", map { "RUNG\n  | $_->{text} |\n" } @rungs;
	print $out "END_PROGRAM\n";
	close $out or die "main.rung: $!";
}

# The numbers of rungs with errors; every message must be about types, or about constants
# that can never succeed.
sub judge {
	my ($row, @rungs) = @_;
	my (%wrong, @odd);
	write_program(@rungs);
	my ($status, $text) = answer('.', $ladder, 'check', "$folder/main.rung");
	for my $line (split /\n/, $text) {
		next if $line !~ / error /;
		$line =~ /: rung (\d+) .*error (?:LD303|LD322|LD324|LD328|LD33[1-8]|LD34[78]|LD116)\b/ ?
			$wrong{$1} = 1 : push @odd, $line;
	}
	is_deeply(\@odd, [], "$row->{word}: messages about types");
	return \%wrong;
}

sub expected {
	my ($row, $one) = @_;
	my ($pin) = grep { !$_->{own} } @{$row->{pins}};
	return undef if !$pin || !$one->{shared} || $one->{out} ne $one->{shared} ||
		$row->{result} !~ /^RESULT_(?:SAME|GATE)$/;
	return $pin->{takes}{$one->{shared}} ? 1 : 0;
}

sub run_good {
	my ($row, @good) = @_;
	my $scans = 4;
	write_program(@good);
	open my $out, '>', "$folder/script" or die "script: $!";
	print $out "\@print SYS_ERRORS\n";
	for my $scan (0 .. $scans - 1) {
		print $out join(' ', map { my $list = $values{$_};
			"v$_=$list->[$scan % @$list]" } @types), "\n";
	}
	close $out or die "script: $!";
	my ($status, $text) = answer('.', $runner, 'trace', "$folder/main.rung", "$folder/script");
	my $lines = () = $text =~ /^\d+ t=/mg;
	ok($status == 0 && $lines == $scans, "$row->{word}: what is good runs") or
		diag(substr $text, 0, 2000);
}

sub test_row {
	my ($row) = @_;
	my (@good, @mistaken);
	my @rungs = combinations($row);
	while (my @some_rungs = splice @rungs, 0, $at_once) {
		my $wrong = judge($row, @some_rungs);
		for my $i (0 .. $#some_rungs) {
			my $is_good = $wrong->{$i + 1} ? 0 : 1;
			my $wanted = expected($row, $some_rungs[$i]);
			push @good, $some_rungs[$i] if $is_good;
			push @mistaken, $some_rungs[$i]{text}
				if defined $wanted && $wanted != $is_good;
		}
	}
	is_deeply(\@mistaken, [], "$row->{word}: takes the types of its row, no others");
	ok(@good > 0, "$row->{word}: something is good");
	run_good($row, @good);
}

diag('without sanitizers: make asan') if !$sanitized;
my @rows = Rows::functions("$tests/../runtime/engine/catalog.def");
ok(@rows > 40, 'rows of functions');
test_row($_) for @rows;
done_testing();
