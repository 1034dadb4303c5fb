#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# modifiers.t - every operator of an instruction list with every modifier is accepted or
# refused as in IEC 61131-3, table 52. Uses `ladder check`; nothing runs.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $tests = abs_path(dirname(__FILE__));
my $ladder = abs_path($ENV{LADDER} || "$tests/../build/ladder");
my $dir = tempdir(CLEANUP => 1);

# Operator, its modifiers, an operand, the value to load before it. STP is not in the
# standard; it behaves like RET.
my @table = (
	[LD  => ['N'],                  'A', ''],
	[ST  => ['N'],                  'A', 'A'],
	[S   => [],                     'A', 'A'],
	[R   => [],                     'A', 'A'],
	[AND => ['N', '(', 'N('],       'A', 'A'],
	[OR  => ['N', '(', 'N('],       'A', 'A'],
	[XOR => ['N', '(', 'N('],       'A', 'A'],
	[NOT => [],                     '',  'A'],
	(map { [$_ => ['('], 'I', 'I'] } qw(ADD SUB MUL DIV MOD GT GE EQ NE LE LT)),
	[JMP => ['C', 'CN'],            'Done', 'A'],
	[CAL => ['C', 'CN'],            'Delay', 'A'],
	[RET => ['C', 'CN'],            '',  'A'],
	[STP => ['C', 'CN'],            '',  'A'],
);
my @modifiers = ('', 'N', 'C', 'CN', 'NC', '(', 'N(', 'C(', 'CN(');

sub program {
	my ($word, $modifier, $operand, $load) = @_;
	my $opens = $modifier =~ /\(/;
	my $list = $load ? "  LD $load\n" : '';
	$list .= "  $word$modifier $operand\n";
	$list .= "  )\n" if $opens;
	return "RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  I : INT;\n  Delay : TON;\nEND_VAR\n\n" .
	       "PROGRAM Main IL\n${list}Done:\n  LD I\n  ST I\nEND_PROGRAM\n";
}

# The codes of the errors of a program, without warnings.
sub errors {
	my ($text) = @_;
	open my $out, '>', "$dir/main.rung" or die $!;
	print $out $text;
	close $out;
	my $said = `cd $dir && $ladder check main.rung 2>&1 >/dev/null`;
	return join ' ', $said =~ /error (LD\d+)/g;
}

for my $row (@table) {
	my ($word, $has, $operand, $load) = @$row;
	for my $modifier (@modifiers) {
		my $taken = $modifier eq '' || grep { $_ eq $modifier } @$has;
		my $got = errors(program($word, $modifier, $operand, $load));
		# S(, R( and the like: a parenthesis in place of an operand
		ok(!!$taken == ($got eq ''), "$word$modifier: " .
		   ($taken ? 'taken' : 'refused')) or diag("said: $got");
	}
}

# A calculation in the place of an operand: the message shows the instructions, and they read.
my @infix = qw(= <> < > <= >= + - * / MOD AND OR XOR & == != && ||);

sub said {
	my ($list) = @_;
	open my $out, '>', "$dir/main.rung" or die $!;
	print $out "RUNGBOARD 1\n\nVAR\n  A, B, Value : BOOL;\n  I, J : INT;\n  Instance : TON;\nEND_VAR\n\n" .
		"PROGRAM Main IL\n${list}Label:\n  LD A\n  ST B\nEND_PROGRAM\n";
	close $out;
	return `cd $dir && $ladder check main.rung 2>&1`;
}

for my $row (@table) {
	my ($word, $has) = @$row;
	for my $modifier ('', @$has) {
		my @lines = map { my $bits = /^(?:AND|OR|XOR|&&?|\|\|)$/;
			"  $word$modifier " . ($bits ? "A $_ B" : "I $_ J") . "\n" } @infix;
		my $said = said(join '', @lines); # fewer than the messages that are mended
		my @steps = $said =~ /error LD188: .*?, a line for each: (.*)/g;
		is(scalar @steps, scalar @lines, "$word$modifier: every calculation is split") or diag($said);
		my $list = join '', map { join('', map { "  $_\n" } split /, then /) .
			($modifier =~ /\(/ ? "  )\n" : '') } @steps;
		unlike(said($list), qr/error LD1/, "$word$modifier: the instructions read") or diag($list);
	}
}
done_testing;
