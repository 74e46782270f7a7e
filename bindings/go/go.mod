module kiri

go 1.24
