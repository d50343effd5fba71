// What to do when the port is not in the list, in Chinese.

import type { Words } from '../en/whole.ts';

const EVERYWHERE = [
  '打开机器人的电源：很多控制板只靠线缆供电不会启动。',
  '换一根 USB 线。有些线只能供电。',
] as const;

const HID_BOARDS =
  'LSC 控制板、总线舵机控制板和 xArm 自带的 USB 线不是串口。请用它的4针接口（GND、TX、RX），接一个5 V 或3.3 V 的 USB 转 TTL 模块。';

export const guideWords: Words['guide'] = {
  title: '列表里没有？',
  system: '这台电脑的系统',
  systems: {
    windows: 'Windows',
    macos: 'macOS',
    linux: 'Linux',
    chromeos: 'ChromeOS',
  },
  steps: {
    windows: [
      ...EVERYWHERE,
      '在设备管理器里查看“端口 (COM 和 LPT)”。如果 CH340 带警告标志，或者出现未知设备，请安装其厂商 WCH（沁恒）的 CH341SER 驱动。',
      '关闭厂商的舵机软件和所有串口助手：一个 COM 口只能被一个程序占用。',
      HID_BOARDS,
    ],
    macos: [
      ...EVERYWHERE,
      '串口的名字类似 “cu.usbserial-110” 或 “cu.wchusbserial110”。macOS 从10.15起自带驱动；厂商的旧驱动可能会冲突，可以卸载。',
      '如果 macOS 询问是否允许连接配件，请允许。',
      HID_BOARDS,
    ],
    linux: [
      ...EVERYWHERE,
      '插上后运行 “sudo dmesg | tail”。看到 “ch341-uart converter now attached to ttyUSB0” 就对了。',
      '如果马上又断开，是盲文服务占用了 CH340：卸载软件包 “brltty”，再重新插上。',
      '如果串口在，但没有权限：运行 “sudo usermod -aG dialout $USER”（Arch 上是 “uucp”），然后注销再登录。',
      'Snap 或 Flatpak 版浏览器可能看不到串口：Snap 请运行 “sudo snap connect chromium:raw-usb”，或者改用浏览器自己的安装包。',
      HID_BOARDS,
    ],
    chromeos: [
      ...EVERYWHERE,
      '如果 ChromeOS 提出把设备连接到 Linux，请不要同意：那样浏览器就用不了它。',
      '学校的电脑可能需要管理员允许使用串口。',
      HID_BOARDS,
    ],
  },
};
