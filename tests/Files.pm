# SPDX-License-Identifier: MIT
#
# Files - whole files and answers of commands, for the tests.
package Files;
use strict;
use warnings;
use Exporter 'import';
use Limit ();
our @EXPORT = qw(slurp spew answer);

# The bytes of a file; undef: it cannot be read. @layer: such as ':encoding(UTF-8)'.
sub slurp {
	my ($path, $layer) = @_;
	open my $in, '<' . ($layer // ':raw'), $path or return undef;
	local $/;
	return scalar(<$in>) // '';
}

# Writes a file and returns its path.
sub spew {
	my ($path, $text, $layer) = @_;
	open my $out, '>' . ($layer // ':raw'), $path or die "$path: $!\n";
	print $out $text;
	close $out or die "$path: $!\n";
	return $path;
}

# Runs a command in a folder. Returns $? and the text of both streams.
sub answer {
	my ($where, @command) = @_;
	my $pid = open my $from, '-|';
	die "fork: $!" if !defined $pid;
	if (!$pid) {
		chdir $where or exit 126;
		open STDERR, '>&', \*STDOUT or die;
		exec @command or die "$command[0]: $!";
	}
	local $/;
	my $text = <$from> // '';
	close $from;
	return ($?, $text);
}

1;
